/* SPDX-License-Identifier: Apache-2.0 */
int client_ping(char ** word);

int client_ping(char ** word)
{
  (void)word;
  return -1;
}
