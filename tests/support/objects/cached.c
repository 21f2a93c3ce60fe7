/* SPDX-License-Identifier: Apache-2.0
 * A cache of objects: this program precedes the compilers in the PATH, under their names (cache.py). It runs the real
 * compiler; where that makes one object from one source (`-c`, `-o`), the object is kept by the hash of what it was made
 * from: compiler, arguments, source, and the text after the preprocessor. All other calls pass through.
 *
 * A call that lists all files which it reads (`-MD`) is found without the preprocessor, too: by compiler, arguments,
 * source, and the content of the files that such a call has read before. The preprocessor, which takes a fifth of the
 * time of a compiler, runs for the second such call that reads other content: most sources of an application occur once.
 *
 * Files are published by rename, so any number of processes may share a cache. A program of the tests, not of the product. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define ARGUMENTS 512
#define BLOCK 65536
#define KEY 33 /* A hash as text. */

typedef unsigned __int128 hash_t;

/** What one call of a compiler says. */
typedef struct call
{
  char * all[ARGUMENTS];        /**< Its arguments, the name of the program first; ends with NULL. */
  char * preprocess[ARGUMENTS]; /**< Those of the same call with -E. */
  const char * source;
  const char * object;
  const char * depfile;
  bool has_depfile;
  bool lists_all; /**< The list of dependencies has the headers of the system, too. */
  bool has_debug;
  bool has_call_graph;
  bool has_stack_usage;
  bool is_one_object;
} call_t;

static const char * const endings[] = {".o", ".d", ".ci", ".su"};

/* FNV-1a, 128 bits: nobody attacks this cache. */
static hash_t hashed(hash_t hash, const void * data, size_t size)
{
  const hash_t prime = ((hash_t)1 << 88) + 0x13b;
  const unsigned char * bytes = data;
  for (size_t i = 0; i < size; i++) {
    hash = (hash ^ bytes[i]) * prime;
  }
  return hash;
}

static hash_t hashed_text(hash_t hash, const char * text)
{
  return hashed(hash, text, strlen(text) + 1);
}

/* Hashes what can be read of `file`, to its end; closes it. */
static hash_t hashed_file(hash_t hash, int file)
{
  static unsigned char block[BLOCK];
  ssize_t size;
  while ((size = read(file, block, sizeof block)) > 0) {
    hash = hashed(hash, block, (size_t)size);
  }
  close(file);
  return hash;
}

static bool ends(const char * text, const char * ending)
{
  const size_t length = strlen(text), wanted = strlen(ending);
  return length > wanted && strcmp(text + length - wanted, ending) == 0;
}

static bool begins(const char * text, const char * beginning)
{
  return strncmp(text, beginning, strlen(beginning)) == 0;
}

/* Finds the compiler that follows in the PATH after the folder of this program; false: nowhere. */
static bool find_real(const char * name, const char * own_folder, char * real)
{
  const char * path = getenv("PATH") != NULL ? getenv("PATH") : "/usr/local/bin:/usr/bin:/bin";
  while (*path != '\0') {
    const size_t length = strcspn(path, ":");
    if (length != strlen(own_folder) || strncmp(path, own_folder, length) != 0) {
      snprintf(real, PATH_MAX, "%.*s/%s", (int)length, path, name);
      if (length > 0 && access(real, X_OK) == 0) {
        return true;
      }
    }
    path += length + (path[length] == ':' ? 1 : 0);
  }
  return false;
}

/* Whether a list of dependencies stands where this program looks for it. */
static bool is_beside(const char * object, const char * depfile)
{
  const size_t stem = strlen(object) - 2;
  return depfile == NULL || (strncmp(object, depfile, stem) == 0 && strcmp(depfile + stem, ".d") == 0);
}

/* Whether files are named in what the compiler makes: a list of dependencies, debug information, frames. */
static bool names_places(const call_t * call)
{
  return call->has_depfile || call->has_debug || call->has_stack_usage;
}

static void read_call(int count, char ** arguments, call_t * call)
{
  static char folder[PATH_MAX], map[2 * PATH_MAX];
  int kept = 0, sources = 0;
  bool compiles = false, known = count < ARGUMENTS - 4;
  for (int i = 0; i < count && known; i++) {
    char * word = arguments[i];
    call->all[i] = word;
    if (i > 0 && strcmp(word, "-c") == 0) {
      compiles = true;
      continue;
    }
    if (i > 0 && (strcmp(word, "-o") == 0 || strcmp(word, "-MF") == 0) && i + 1 < count) {
      call->object = word[1] == 'o' ? arguments[i + 1] : call->object;
      call->depfile = word[1] == 'M' ? arguments[i + 1] : call->depfile;
      call->all[i + 1] = arguments[i + 1];
      i++;
      continue;
    }
    if (i > 0 && begins(word, "-M")) {
      call->has_depfile = true;
      call->lists_all = call->lists_all || strcmp(word, "-MD") == 0;
      known = strcmp(word, "-MMD") == 0 || strcmp(word, "-MD") == 0;
      continue;
    }
    if (word[0] != '-' && i > 0 && (ends(word, ".c") || ends(word, ".cpp") || ends(word, ".cc"))) {
      call->source = word;
      sources++;
    }
    call->has_debug = call->has_debug || (begins(word, "-g") && strcmp(word, "-g0") != 0);
    call->has_call_graph = call->has_call_graph || begins(word, "-fcallgraph-info");
    call->has_stack_usage = call->has_stack_usage || strcmp(word, "-fstack-usage") == 0;
    known = known && word[0] != '@' && strcmp(word, "-") != 0 && !begins(word, "-save-temps") &&
            strcmp(word, "--coverage") != 0 && strcmp(word, "-x") != 0 && strcmp(word, "-E") != 0;
    call->preprocess[kept++] = word;
  }
  call->is_one_object = known && compiles && sources == 1 && call->object != NULL && ends(call->object, ".o") &&
                        is_beside(call->object, call->depfile);
  if (call->is_one_object && call->has_debug && call->source[0] != '/' && getcwd(folder, sizeof folder) != NULL) {
    /* Debug information names files from the folder of the call on, so the object is the same in any folder. */
    snprintf(map, sizeof map, "-fdebug-prefix-map=%s=.", folder);
    call->all[count] = map;
    call->preprocess[kept++] = "-fno-working-directory";
  }
  call->preprocess[kept++] = "-E";
  /* Where nothing that is made names files, their places do not count. */
  call->preprocess[kept] = names_places(call) ? NULL : "-P";
}

/* Runs the compiler, with standard output to `out` and errors to `errors` where these are not negative. */
static int run(const char * real, char ** arguments, int out, int errors)
{
  const pid_t child = fork();
  if (child == 0) {
    if (out >= 0) {
      dup2(out, STDOUT_FILENO);
    }
    if (errors >= 0) {
      dup2(errors, STDERR_FILENO);
    }
    execv(real, arguments);
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/* Copies a file; it appears under its name complete. Returns false if the file does not exist or it cannot be written. */
static bool publish(const char * from, const char * to)
{
  char fresh[PATH_MAX];
  static char block[BLOCK];
  const int source = open(from, O_RDONLY | O_CLOEXEC);
  if (source < 0 || snprintf(fresh, sizeof fresh, "%s.%ld", to, (long)getpid()) >= (int)sizeof fresh) {
    return false;
  }
  const int target = open(fresh, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  bool good = target >= 0;
  ssize_t size;
  while (good && (size = read(source, block, sizeof block)) != 0) {
    good = size > 0 && write(target, block, (size_t)size) == size;
  }
  close(source);
  good = target >= 0 && close(target) == 0 && good;
  if (!good || rename(fresh, to) != 0) {
    unlink(fresh);
    return false;
  }
  return true;
}

/* Gives the place of one of the files next to the object: its name with another ending. */
static void beside(const call_t * call, const char * ending, char * place)
{
  snprintf(place, PATH_MAX, "%.*s%s", (int)(strlen(call->object) - 2), call->object, ending);
}

/* Hashes compiler, arguments and source; false: one of the files cannot be read. */
static bool hash_call(const char * real, const call_t * call, hash_t * hashed_call)
{
  struct stat compiler;
  const int source = open(call->source, O_RDONLY | O_CLOEXEC);
  if (stat(real, &compiler) != 0 || source < 0) {
    return false;
  }
  hash_t hash = hashed_text(((hash_t)0x6c62272e07bb0142U << 64) + 0x62b821756295c58dU, real);
  hash = hashed(hash, &compiler.st_size, sizeof compiler.st_size);
  hash = hashed(hash, &compiler.st_mtim, sizeof compiler.st_mtim);
  for (char * const * word = call->all + 1; *word != NULL; word++) {
    if (begins(*word, "-fdebug-prefix-map=")) {
      continue;
    }
    const bool is_place = begins(*word, "-I") || strcmp(*word, call->source) == 0 || strcmp(*word, call->object) == 0;
    if (names_places(call) || !is_place) {
      hash = hashed_text(hash, *word);
    }
  }
  hash = hashed_text(hash, strrchr(call->source, '/') != NULL ? strrchr(call->source, '/') : call->source);
  *hashed_call = hashed_file(hash, source); /* Warnings depend on comments too. */
  return true;
}

static void write_key(hash_t hash, char * key)
{
  snprintf(key, KEY, "%016llx%016llx", (unsigned long long)(hash >> 64), (unsigned long long)hash);
}

/* Adds the text after the preprocessor; false: it refuses the source. */
static bool hash_preprocessed(const char * real, const call_t * call, hash_t * hash)
{
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  int ends_of_pipe[2];
  if (nowhere < 0 || pipe2(ends_of_pipe, O_CLOEXEC) != 0) {
    return false;
  }
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends_of_pipe[1], STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execv(real, (char **)call->preprocess);
    _exit(127);
  }
  close(ends_of_pipe[1]);
  *hash = hashed_file(*hash, ends_of_pipe[0]);
  int status = 1;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  close(nowhere);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* Gives the place of the files of `key`, and makes its folder. */
static void place_of(const char * cache, const char * key, const char * ending, char * place)
{
  snprintf(place, PATH_MAX, "%s/%.2s", cache, key);
  mkdir(place, 0777);
  snprintf(place, PATH_MAX, "%s/%.2s/%s%s", cache, key, key, ending);
}

/* Reads a small file to its end, with a zero after it; false: it is not there, or larger than `size`. */
static bool read_text(const char * place, char * text, size_t size)
{
  const int file = open(place, O_RDONLY | O_CLOEXEC);
  ssize_t got = file >= 0 ? read(file, text, size) : -1;
  if (file >= 0) {
    close(file);
  }
  text[got > 0 ? got : 0] = '\0';
  return got > 0 && (size_t)got < size;
}

/* Adds the content of the files of a list of dependencies: `object: file file \ file`; false: one cannot be read. */
static bool hash_listed(char * list, hash_t * hash)
{
  char * colon = strstr(list, ": ");
  if (colon == NULL || strstr(list, "\\ ") != NULL) { /* A name with a space. */
    return false;
  }
  for (char * name = strtok(colon + 1, " \\\n"); name != NULL; name = strtok(NULL, " \\\n")) {
    const int file = open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0) {
      return false;
    }
    *hash = hashed_file(hashed_text(*hash, name), file);
  }
  return true;
}

typedef enum seen { NEVER, WITH_OTHER_FILES, WITH_THESE_FILES } seen_t;

/* Finds the key of the object of a call that has been seen with the same files: what they led to is in a link. */
static seen_t find_listed(const char * cache, hash_t call, char * key)
{
  char place[PATH_MAX], name[KEY];
  static char list[BLOCK];
  write_key(call, name);
  place_of(cache, name, ".d", place);
  if (!read_text(place, list, sizeof list - 1)) {
    return NEVER;
  }
  if (!hash_listed(list, &call)) {
    return WITH_OTHER_FILES;
  }
  write_key(call, name);
  place_of(cache, name, ".to", place);
  const ssize_t size = readlink(place, key, KEY);
  key[size == KEY - 1 ? size : 0] = '\0';
  return size == KEY - 1 ? WITH_THESE_FILES : WITH_OTHER_FILES;
}

/* Keeps the list of files that a call has read, and the key of the object that their content leads to. */
static void keep_listed(const char * cache, const call_t * made, hash_t call, const char * key)
{
  char place[PATH_MAX], fresh[PATH_MAX], name[KEY];
  static char list[BLOCK];
  write_key(call, name);
  place_of(cache, name, ".d", place);
  if (!read_text(made->depfile, list, sizeof list - 1) || !publish(made->depfile, place) || !hash_listed(list, &call)) {
    return;
  }
  write_key(call, name);
  place_of(cache, name, ".to", place);
  if (snprintf(fresh, sizeof fresh, "%s.%ld", place, (long)getpid()) >= (int)sizeof fresh || symlink(key, fresh) != 0 ||
      rename(fresh, place) != 0) {
    unlink(fresh);
  }
}

/* Copies the object cached under `entry` to its destination, with the compiler's messages; false if it is not cached. */
static bool recall(const call_t * call, const char * entry)
{
  char kept[PATH_MAX], place[PATH_MAX];
  static char said[BLOCK];
  snprintf(kept, sizeof kept, "%s.err", entry);
  const int errors = open(kept, O_RDONLY | O_CLOEXEC);
  if (errors < 0) {
    return false;
  }
  for (size_t i = sizeof endings / sizeof endings[0]; i-- > 0;) {
    snprintf(kept, sizeof kept, "%s%s", entry, endings[i]);
    beside(call, endings[i], place);
    if (!publish(kept, place) && i == 0) {
      close(errors);
      return false;
    }
  }
  const ssize_t size = read(errors, said, sizeof said);
  (void)!write(STDERR_FILENO, said, size > 0 ? (size_t)size : 0);
  close(errors);
  snprintf(kept, sizeof kept, "%s.err", entry);
  utimensat(AT_FDCWD, kept, NULL, 0);
  return true;
}

/* Compiles, and keeps what came of it when the compiler was content. */
static int compile(const char * real, call_t * call, const char * entry)
{
  char kept[PATH_MAX], place[PATH_MAX], words[PATH_MAX];
  static char said[BLOCK];
  snprintf(words, sizeof words, "%s.words.%ld", entry, (long)getpid());
  const int errors = open(words, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const int status = run(real, call->all, -1, errors);
  ssize_t size = 0;
  for (off_t at = 0; errors >= 0 && (size = pread(errors, said, sizeof said, at)) > 0; at += size) {
    (void)!write(STDERR_FILENO, said, (size_t)size);
  }
  close(errors);
  bool good = status == 0;
  for (size_t i = 0; good && i < sizeof endings / sizeof endings[0]; i++) {
    const bool makes[] = {true, call->has_depfile, call->has_call_graph, call->has_stack_usage};
    snprintf(kept, sizeof kept, "%s%s", entry, endings[i]);
    beside(call, endings[i], place);
    good = !makes[i] || publish(place, kept);
  }
  snprintf(kept, sizeof kept, "%s.err", entry); /* Last: with it the entry is whole. */
  if (!good || rename(words, kept) != 0) {
    unlink(words);
  }
  return status;
}

/* Gives the folder of this program, and that of the cache, which it is in. */
static bool find_folders(char * own, char * cache)
{
  const ssize_t size = readlink("/proc/self/exe", own, PATH_MAX - 1);
  own[size > 0 ? size : 0] = '\0';
  char * slash = strrchr(own, '/');
  if (slash == NULL) {
    return false;
  }
  *slash = '\0';
  strcpy(cache, own);
  slash = strrchr(cache, '/');
  if (slash != NULL) {
    *slash = '\0';
  }
  return slash != NULL;
}

/* Whether this is a call of `microros-gen build` (it asks for the call graph) that keeps its objects itself. */
static bool is_of_build(const call_t * call)
{
  const char * store = getenv("MICROROS_GEN_OBJECTS");
  return call->has_call_graph && store != NULL && store[0] != '\0' && strcmp(store, "off") != 0;
}

/* Adds what no other process has at any time: two that meet the same call first may read other files. */
static hash_t hash_own(hash_t hash)
{
  struct timespec now;
  const pid_t own = getpid();
  (void)clock_gettime(CLOCK_REALTIME, &now);
  hash = hashed(hash, &own, sizeof own);
  hash = hashed(hash, &now.tv_sec, sizeof now.tv_sec);
  return hashed(hash, &now.tv_nsec, sizeof now.tv_nsec);
}

/* Takes the object from the cache or compiles it; returns the compiler's status, negative: the call must pass through. */
static int make_object(const char * real, const char * cache, call_t * call)
{
  char key[KEY], entry[PATH_MAX];
  hash_t of_call, of_text;
  const bool lists_all = call->lists_all && call->depfile != NULL;
  if (!hash_call(real, call, &of_call)) {
    return -1;
  }
  const seen_t seen = lists_all ? find_listed(cache, of_call, key) : WITH_OTHER_FILES;
  if (seen == WITH_THESE_FILES) {
    place_of(cache, key, "", entry);
    if (recall(call, entry)) {
      return 0;
    }
  }
  of_text = of_call;
  if (seen == NEVER) {
    of_text = hash_own(of_text);
  } else if (!hash_preprocessed(real, call, &of_text)) {
    return -1;
  }
  write_key(of_text, key);
  place_of(cache, key, "", entry);
  const int status = recall(call, entry) ? 0 : compile(real, call, entry);
  if (status == 0 && lists_all) {
    keep_listed(cache, call, of_call, key);
  }
  return status;
}

int main(int count, char ** arguments)
{
  static call_t call;
  char real[PATH_MAX], own[PATH_MAX], cache[PATH_MAX];
  const char * slash = strrchr(arguments[0], '/');
  const char * name = slash != NULL ? slash + 1 : arguments[0];
  if (!find_folders(own, cache) || !find_real(name, own, real)) {
    fprintf(stderr, "%s: no real compiler next to the cache of the tests\n", name);
    return 127;
  }
  arguments[0] = real;
  read_call(count, arguments, &call);
  if (call.is_one_object && !is_of_build(&call)) {
    const int status = make_object(real, cache, &call);
    if (status >= 0) {
      return status;
    }
  }
  execv(real, arguments);
  return 127;
}
