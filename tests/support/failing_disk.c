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

static long writes;

static int is_set(const char *name, const char *value)
{
  const char *found = getenv(name);
  return found && !strcmp(found, value);
}

static int is_watched(int descriptor)
{
  const char *rank = getenv("OMPI_COMM_WORLD_RANK"), *name = getenv("FAILING_NAME");
  char link[64], path[4096];
  ssize_t length;

  if (!name || !is_set("FAILING_RANK", rank ? rank : "0")) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  length = readlink(link, path, sizeof path - 1);
  if (length < (ssize_t)strlen(name)) return 0;
  path[length] = 0;
  return !strcmp(path + length - strlen(name), name);
}

static int fails(int descriptor)
{
  const char *first = getenv("FAILING_FIRST");

  if (!is_watched(descriptor)) return 0;
  writes++;
  if (!first || atol(first) == 0 || writes < atol(first)) return 0;
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
