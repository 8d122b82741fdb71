/* Count the allocations of a program: put in front of the C library of GNU, see allocations.py. */
#include <stdio.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

static long allocations, bytes;

static void count(size_t size)
{
  __sync_fetch_and_add(&allocations, 1);
  __sync_fetch_and_add(&bytes, (long)size);
}

void *malloc(size_t size)
{
  count(size);
  return __libc_malloc(size);
}

void *calloc(size_t number, size_t size)
{
  count(number * size);
  return __libc_calloc(number, size);
}

void *realloc(void *block, size_t size)
{
  count(size);
  return __libc_realloc(block, size);
}

__attribute__((destructor)) static void tell(void)
{
  fprintf(stderr, "%ld allocations of %ld bytes\n", allocations, bytes);
}
