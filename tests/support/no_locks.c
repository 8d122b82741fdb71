/* A file system without locks: put in front of the C library, as some network file systems answer. */
#include <errno.h>

int flock(int descriptor, int operation)
{
  (void)descriptor;
  (void)operation;
  errno = ENOLCK;
  return -1;
}
