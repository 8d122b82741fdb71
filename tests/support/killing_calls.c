/* Kills the program before one of the calls that change files: put in front of the C library of GNU.

   KILL_AT is the number of the call, 0 for none; without a kill the program tells at its end how many
   there were. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>

static long calls, last;

__attribute__((constructor)) static void read_environment(void)
{
  const char *count = getenv("KILL_AT");

  if (count) last = atol(count);
}

static void count_call(void)
{
  if (++calls == last) kill(getpid(), SIGKILL);
}

#define WATCHED(type, name, arguments, values)              \
  type name arguments                                       \
  {                                                         \
    type(*real) arguments = dlsym(RTLD_NEXT, #name);        \
    count_call();                                           \
    return real values;                                     \
  }

WATCHED(ssize_t, write, (int file, const void *data, size_t size), (file, data, size))
WATCHED(ssize_t, pwrite, (int file, const void *data, size_t size, off_t place),
        (file, data, size, place))
WATCHED(ssize_t, pwrite64, (int file, const void *data, size_t size, off64_t place),
        (file, data, size, place))
WATCHED(int, ftruncate, (int file, off_t size), (file, size))
WATCHED(int, ftruncate64, (int file, off64_t size), (file, size))
WATCHED(int, fsync, (int file), (file))
WATCHED(int, rename, (const char *from, const char *to), (from, to))
WATCHED(int, unlink, (const char *path), (path))

__attribute__((destructor)) static void tell(void)
{
  fprintf(stderr, "%ld watched calls\n", calls);
}
