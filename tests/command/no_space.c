/* SPDX-License-Identifier: BSD-3-Clause
 * Preloaded by test_faults.py: from write number NO_SPACE_AFTER on, nothing goes to files below the folder NO_SPACE_IN any more, as
 * on a full disk. It stays full; what is there can be read, renamed and removed. Writes are counted in the file NO_SPACE_COUNT.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

static long writes;

static int is_full(int file) {
  const char *folder = getenv("NO_SPACE_IN"), *after = getenv("NO_SPACE_AFTER");
  if (!folder || !after) return 0;
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return 0;
  path[size] = 0;
  if (strncmp(path, folder, strlen(folder)) != 0) return 0;
  if (++writes <= atol(after)) return 0;
  errno = ENOSPC;
  return 1;
}

__attribute__((destructor)) static void tell(void) {
  const char *path = getenv("NO_SPACE_COUNT");
  FILE *file = path ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", writes);
  fclose(file);
}

#define NEXT(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int file, const void *data, size_t size) {
  return is_full(file) ? -1 : NEXT(ssize_t, "write", int, const void *, size_t)(file, data, size);
}
ssize_t pwrite(int file, const void *data, size_t size, off_t at) {
  return is_full(file) ? -1 : NEXT(ssize_t, "pwrite", int, const void *, size_t, off_t)(file, data, size, at);
}
ssize_t pwrite64(int file, const void *data, size_t size, off64_t at) {
  return is_full(file) ? -1 : NEXT(ssize_t, "pwrite64", int, const void *, size_t, off64_t)(file, data, size, at);
}
int fdatasync(int file) { return is_full(file) ? -1 : NEXT(int, "fdatasync", int)(file); }
/* stdio writes by ways of its own: when it is emptied */
int fflush(FILE *file) { return file && is_full(fileno(file)) ? EOF : NEXT(int, "fflush", FILE *)(file); }
int fclose(FILE *file) {
  const int full = is_full(fileno(file)), reason = errno;
  const int closed = NEXT(int, "fclose", FILE *)(file);
  if (!full) return closed;
  errno = reason;
  return EOF;
}
