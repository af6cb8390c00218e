/* A disk that fails: loaded before the program (LD_PRELOAD), it lets the writes to one file go wrong.
 *
 *   FAIL_FILE  the end of the file's path; other files are left alone
 *   FAIL_AT    the first write that fails, counted from 1; 0: none
 *   FAIL_WITH  the error's number; half of the first failing write still goes through, as on a disk that fills up
 *   FAIL_ONCE  if 1: only that write fails, as where a disk is full for a moment
 *   FAIL_SYNC  if 1: what cannot be forced to disk is the file, its writes go through
 *   FAIL_LOG   where the number of writes is left at the end, and behind it how often the file was forced to disk
 *
 * Else all fail from the first failing write on, writes and resizing of that file. The program's own calls go through
 * write, writev, pwrite and ftruncate, libraries' too; stdio's do not, so the terminal is left alone. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

static int writes, syncs;

static const char* setting(const char* name) {
  const char* value = getenv(name);
  return value ? value : "";
}

/* Whether the descriptor's file is the one. */
static int is_meant(int descriptor) {
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  const char* end = setting("FAIL_FILE");
  const size_t size = strlen(end);
  return size > 0 && length >= (ssize_t)size && memcmp(path + length - (ssize_t)size, end, size) == 0;
}

/* How much of a write of `size` bytes goes through: all of it, half, or none, with the error set. */
static ssize_t granted(int descriptor, size_t size) {
  if (!is_meant(descriptor)) return (ssize_t)size;
  const int at = atoi(setting("FAIL_AT"));
  ++writes;
  if (at == 0 || writes < at || *setting("FAIL_SYNC")) return (ssize_t)size;
  if (*setting("FAIL_ONCE")) {
    errno = atoi(setting("FAIL_WITH"));
    return writes == at ? -1 : (ssize_t)size;
  }
  errno = atoi(setting("FAIL_WITH"));
  return writes == at && size > 1 ? (ssize_t)(size / 2) : -1;
}

static void* next(const char* name) {
  return dlsym(RTLD_NEXT, name);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const ssize_t some = granted(descriptor, size);
  return some < 0 ? -1 : ((ssize_t(*)(int, const void*, size_t))next("write"))(descriptor, bytes, (size_t)some);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  size_t size = 0;
  for (int k = 0; k < count; ++k) size += parts[k].iov_len;
  if (granted(descriptor, size) < (ssize_t)size) return -1;
  return ((ssize_t(*)(int, const struct iovec*, int))next("writev"))(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
  const ssize_t some = granted(descriptor, size);
  if (some < 0) return -1;
  return ((ssize_t(*)(int, const void*, size_t, off_t))next("pwrite"))(descriptor, bytes, (size_t)some, at);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  return pwrite(descriptor, bytes, size, at);
}

/* A file that could not grow may still be cut. */
static int may_resize(int descriptor, off_t size) {
  const int at = atoi(setting("FAIL_AT"));
  return at == 0 || writes < at || *setting("FAIL_ONCE") || !is_meant(descriptor) || size <= lseek(descriptor, 0, SEEK_END);
}

int ftruncate(int descriptor, off_t size) {
  const off_t here = lseek(descriptor, 0, SEEK_CUR);
  const int may = may_resize(descriptor, size);
  lseek(descriptor, here, SEEK_SET);
  if (may) return ((int (*)(int, off_t))next("ftruncate"))(descriptor, size);
  errno = atoi(setting("FAIL_WITH"));
  return -1;
}

int ftruncate64(int descriptor, off64_t size) {
  return ftruncate(descriptor, size);
}

int fsync(int descriptor) {
  if (is_meant(descriptor)) {
    ++syncs;
    if (*setting("FAIL_SYNC")) {
      errno = atoi(setting("FAIL_WITH"));
      return -1;
    }
  }
  return ((int (*)(int))next("fsync"))(descriptor);
}

__attribute__((destructor)) static void tell(void) {
  const char* log = setting("FAIL_LOG");
  if (!*log) return;
  FILE* file = fopen(log, "w");
  if (!file) return;
  fprintf(file, "%d %d\n", writes, syncs);
  fclose(file);
}
