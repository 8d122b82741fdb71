/* A disk that fails for one rank: put in front of the C library of GNU, see failing_disk.py.

   Of the writes to files whose names end with FAILING_NAME, those of rank FAILING_RANK fail from
   number FAILING_FIRST on, as on a disk without room; 0 for none. At the end the rank tells how many
   there were. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

/* Writes so far, and the first that fails; how the names of their files end, nothing on other ranks */
static long writes, first;
static char watched[4096];

/* Before there are threads: one that starts MPI changes the environment while others write */
__attribute__((constructor)) static void read_environment(void)
{
  const char *rank = getenv("OMPI_COMM_WORLD_RANK"), *failing = getenv("FAILING_RANK");
  const char *name = getenv("FAILING_NAME"), *count = getenv("FAILING_FIRST");

  if (name && failing && !strcmp(failing, rank ? rank : "0")) {
    snprintf(watched, sizeof watched, "%s", name);
  }
  if (count) first = atol(count);
}

static int is_watched(int descriptor)
{
  char link[64], path[4096];
  ssize_t length;

  if (!watched[0]) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  length = readlink(link, path, sizeof path - 1);
  if (length < (ssize_t)strlen(watched)) return 0;
  path[length] = 0;
  return !strcmp(path + length - strlen(watched), watched);
}

static int fails(int descriptor)
{
  if (!is_watched(descriptor)) return 0;
  writes++;
  if (first == 0 || writes < first) return 0;
  errno = ENOSPC;
  return 1;
}

#define INSTEAD(name, arguments, values)                    \
  ssize_t name arguments                                    \
  {                                                         \
    ssize_t(*real) arguments = dlsym(RTLD_NEXT, #name);     \
    return fails(descriptor) ? -1 : real values;            \
  }

INSTEAD(write, (int descriptor, const void *data, size_t size), (descriptor, data, size))
INSTEAD(pwrite, (int descriptor, const void *data, size_t size, off_t place),
        (descriptor, data, size, place))
INSTEAD(pwrite64, (int descriptor, const void *data, size_t size, off64_t place),
        (descriptor, data, size, place))
INSTEAD(writev, (int descriptor, const struct iovec *data, int count), (descriptor, data, count))
INSTEAD(pwritev, (int descriptor, const struct iovec *data, int count, off_t place),
        (descriptor, data, count, place))
INSTEAD(pwritev64, (int descriptor, const struct iovec *data, int count, off64_t place),
        (descriptor, data, count, place))

__attribute__((destructor)) static void tell(void)
{
  if (writes > 0) fprintf(stderr, "%ld watched writes\n", writes);
}
