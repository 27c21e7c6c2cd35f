/* ARPACK's Lanczos iteration for A x = mu B x, shift-invert mode about -1.
 *
 * With OP = (A + B)^-1 B, symmetric in the inner product of B, ARPACK asks for products in turn
 * ("reverse communication") and this loop answers. All memory is the caller's.
 */
#include <string.h>

#include "arpack.h"

struct problem {
    int size, wanted, basis, most_restarts;
    double tolerance;
    double *start;    /* size: the start vector; overwritten */
    double *vectors;  /* size * basis: eigenvectors in the first columns */
    double *products; /* 3 * size */
    double *work;     /* basis * (basis + 8) */
    double *values;   /* basis: mu of the converged */
    a_int *selected;  /* basis */
    void *context;
    int (*mass)(void *context, const double *x, double *y); /* y = B x; not 0 to stop */
    int (*inverse)(void *context, double *y);               /* y = (A + B)^-1 y; not 0 to stop */
    int converged, steps;                                   /* answers */
};

/* 0: done, some or all converged; 1: a product asked to stop; 2: ARPACK failed. */
int sweetspot_arpack(struct problem *p) {
    a_int iparam[11] = {1, 0, p->most_restarts, 1, 0, 0, 3}, ipntr[14] = {0};
    a_int ido = 0, info = 1, lworkl = (a_int)p->basis * (p->basis + 8);
    p->converged = p->steps = 0;
    for (;;) {
        dsaupd_c(&ido, "G", p->size, "LM", p->wanted, p->tolerance, p->start, p->basis,
                 p->vectors, p->size, iparam, ipntr, p->products, p->work, lworkl, &info);
        if (ido != -1 && ido != 1 && ido != 2)
            break;
        const double *x = p->products + ipntr[0] - 1;
        double *y = p->products + ipntr[1] - 1;
        if (ido == 1) /* B x is there already */
            memcpy(y, p->products + ipntr[2] - 1, (size_t)p->size * sizeof *y);
        else if (p->mass(p->context, x, y))
            return 1;
        if (ido != 2) {
            p->steps++;
            if (p->inverse(p->context, y))
                return 1;
        }
    }
    p->converged = (int)iparam[4];
    if (ido != 99 || info < 0)
        return 2;
    if (p->converged == 0)
        return 0;
    dseupd_c(1, "A", p->selected, p->values, p->vectors, p->size, -1.0, "G", p->size, "LM",
             p->wanted, p->tolerance, p->start, p->basis, p->vectors, p->size, iparam, ipntr,
             p->products, p->work, lworkl, &info);
    return info == 0 ? 0 : 2;
}
