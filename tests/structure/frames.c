/* Calling contexts of a program built with -finstrument-functions: each procedure under each chain
   of callers, and how often it was called so. They go to the file that FRAMES names, a line each:
   number of the context, that of its caller, address of the procedure, calls. */
#include <stdio.h>
#include <stdlib.h>

#define MOST 65536 /* contexts; a power of two */
#define HIDDEN __attribute__((no_instrument_function))

static struct { void *procedure; int caller, calls; } contexts[MOST];
static __thread int here = 0;

/* Place of a procedure below a caller; place 0 is outside of all */
HIDDEN static int place_of(void *procedure, int caller)
{
    unsigned place = (unsigned)(((size_t)procedure >> 4) * 31u + (size_t)caller * 65537u);
    for (int tries = 0; tries < MOST; tries++, place++) {
        place &= MOST - 1;
        if (place == 0)
            continue;
        if (contexts[place].calls == 0) {
            contexts[place].procedure = procedure;
            contexts[place].caller = caller;
        }
        if (contexts[place].procedure == procedure && contexts[place].caller == caller)
            return (int)place;
    }
    abort();
}

HIDDEN void __cyg_profile_func_enter(void *procedure, void *site)
{
    here = place_of(procedure, here);
    contexts[here].calls++;
}

HIDDEN void __cyg_profile_func_exit(void *procedure, void *site)
{
    here = contexts[here].caller;
}

HIDDEN __attribute__((destructor)) static void write_contexts(void)
{
    const char *name = getenv("FRAMES");
    FILE *file = name ? fopen(name, "w") : NULL;
    if (!file)
        return;
    for (int k = 1; k < MOST; k++)
        if (contexts[k].calls > 0)
            fprintf(file, "%d %d %zx %d\n", k, contexts[k].caller, (size_t)contexts[k].procedure,
                    contexts[k].calls);
    fclose(file);
}
