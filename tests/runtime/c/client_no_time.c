/* SPDX-License-Identifier: Apache-2.0 */
int client_time(char ** word);

int client_time(char ** word)
{
  (void)word;
  return -1;
}
