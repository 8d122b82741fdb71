/* Ask for memory ahead of its use, which waits for nothing. Fortran has no word for it. */
enum { line = 64, in_second_cache = 2, to_read = 0 };

void plydyn_prefetch(const char *first, long bytes)
{
  for (long k = 0; k < bytes; k += line)
    __builtin_prefetch(first + k, to_read, in_second_cache);
}
