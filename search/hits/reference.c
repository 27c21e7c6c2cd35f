/* Ball and bat in contact, by Taylor series: the truth for the program's hits.
 *
 *     x + C F(x) = z + sum y_n           x the ball's compression, C the flexibility of modes left out
 *     z''   = -F/mu                      1/mu = 1/m + 1/M_eff
 *     y_n'' = -2 zeta w y_n' - w^2 y_n - c_n F
 *     F = k x^a                          at a compression that it has not had before
 *     F = k xm^a (x/xm)^b                below the largest so far, b = (1 + a)/e^2 - 1
 *
 * Each step takes the series of all motions to the 26th power of the time; the power of a series
 * is the recurrence P_k = 1/(k x_0) sum_{j=1..k} (a j - (k - j)) x_j P_{k-j} of Leibniz's rule on
 * x P' = a x' P. The series are the motion inside the step, so that the largest compression, the
 * return to it and the end are found on them by bisection to the last bit. After the ball has left,
 * every mode is its own exact cosine, and the next touch is looked for in strides in which, by a
 * bound on the second derivative, there can be none; the ball is gone when all amplitudes together
 * do not reach it. A ball that left is round again: a later touch begins on the first branch. One that
 * has flown for 110 times as long as it takes to be compressed and for 20 ms, and would be met again, is gone, since
 * a swung bat has turned away by then; near that time there is no answer.
 *
 * Source of the law and of the equations: A. M. Nathan, Am. J. Phys. 68, 979 (2000). Series:
 * G. Corliss, Y. F. Chang, ACM TOMS 8, 114 (1982).
 *
 * It shares no code and no idea with src/collision: no Lobatto points, no tables, no corrections.
 *
 * The ball, its force and the rigid motion are in long double, the modes' parts in double.
 *
 *     cc -O3 -o reference reference.c -lm; ./reference < hits
 *
 * Reads hits: `count 1/mu C k a e u` and `count` lines `w zeta c` (SI). Writes for each
 * `J J_first time contacts reloads imbalance slack`: impulses (N s), the sum of the times in touch
 * (s), how often it touched and how often it was compressed anew, the energy not accounted for
 * (share of mu u^2/2), and the smallest amount (share of xm) by which a reload or a new touch was
 * missed or happened. A hit without an answer, or that touches 10000 times, writes nan. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef long double Real;
typedef double Part; /* of a mode, which adds little to what it is added to */
enum { ORDER = 26, LOOKS = 24, MOST = 4096 };
static const Real TINY = 1e-17L;  /* what a step may be off by, relative */
static const Real GONE = 110;      /* times the ball's own, which are a flight without end */
static const Real LATE = 0.02L;   /* s, before which none is */
static const Real FIRST = 1e-11L; /* s, in which a ball that is hardly touched does not push */

static int count;
static Real inverse_mass, rest, stiffness, loading, unloading, speed, scale;
static Part square[MOST], friction[MOST], gain[MOST], y[ORDER + 1][MOST];
static Real z[ORDER + 1], r[ORDER + 1], x[ORDER + 1], force[ORDER + 1];
static Real largest; /* compression so far (m) */
static int back;     /* below the largest compression */

/* The force at a compression, and its exponent. */
static Real push(Real at, Real *exponent) {
    *exponent = back ? unloading : loading;
    Real top = stiffness * powl(largest, loading);
    return back ? top * powl(at / largest, unloading) : stiffness * powl(at, loading);
}

/* The compression where x + C F(x) = whole, from a guess. */
static Real split(Real whole) {
    Real a, low = 0, high = whole, at = whole;
    if (rest > 0) {
        /* all of it in the flexibility is more force than there is */
        Real top = stiffness * powl(largest, loading), most = whole / rest;
        Real there = back ? largest * powl(most / top, 1 / unloading)
                          : powl(most / stiffness, 1 / loading);
        at = high = fminl(whole, there);
    }
    for (int k = 0; k < 1000 && rest > 0; k++) {
        Real f = push(at, &a), off = at + rest * f - whole;
        if (off > 0) high = at; else low = at;
        Real next = at - off / (1 + rest * a * f / at);
        if (!(next > low && next < high)) next = (low + high) / 2;
        if (fabsl(next - at) <= LDBL_EPSILON * at) return next;
        at = next;
    }
    return at;
}

static Real total(const Part *parts) {
    Part sum = 0;
    for (int n = 0; n < count; n++) sum += parts[n];
    return sum;
}

/* All series from y[0], y[1], z[0], z[1]. */
static void series(void) {
    Real a;
    for (int k = 0; k <= ORDER; k++) {
        r[k] = z[k];
        r[k] += total(y[k]);
        if (k == 0) {
            x[0] = split(r[0]);
            force[0] = push(x[0], &a);
        } else {
            Real known = 0;
            for (int j = 1; j < k; j++) known += (a * j - (k - j)) * x[j] * force[k - j];
            known /= k * x[0];
            Real slope = a * force[0] / x[0];
            x[k] = (r[k] - rest * known) / (1 + rest * slope);
            force[k] = known + slope * x[k];
        }
        if (k + 2 > ORDER) continue;
        Part share = 1.0 / ((k + 1) * (k + 2)), pushed = force[k];
        z[k + 2] = -inverse_mass * force[k] / ((k + 1) * (k + 2));
        for (int n = 0; n < count; n++)
            y[k + 2][n] = share * (-friction[n] * (k + 1) * y[k + 1][n] - square[n] * y[k][n]
                                   - gain[n] * pushed);
    }
}

static Real sum(const Real *c, int last, Real t) {
    Real s = 0;
    for (int k = last; k >= 0; k--) s = s * t + c[k];
    return s;
}

static Real rate(const Real *c, int last, Real t) {
    Real s = 0;
    for (int k = last; k >= 1; k--) s = s * t + k * c[k];
    return s;
}

/* How long the series hold. */
static Real reach(Real fastest) {
    Real most = push(fmaxl(largest, x[0]), &(Real){0});
    Real h = fastest > 0 ? 3.0L / fastest : HUGE_VALL;
    for (int k = ORDER - 3; k <= ORDER; k++) {
        if (x[k] != 0) h = fminl(h, powl(TINY * scale / fabsl(x[k]), 1.0L / k));
        if (force[k] != 0) h = fminl(h, powl(TINY * most / fabsl(force[k]), 1.0L / k));
    }
    /* A power is not one beyond the zero of its base. */
    if (x[1] != 0) h = fminl(h, 0.5L * x[0] / fabsl(x[1]));
    /* The last terms of a steep force that is next to nothing do not show yet how it goes on. */
    for (int k = 0; k < 60; k++) {
        Real off = 0;
        for (int part = 1; part <= 2; part++) {
            Real t = h * part / 2, at = sum(x, ORDER, t);
            if (at > 0) off = fmaxl(off, fabsl(sum(force, ORDER, t) - push(at, &(Real){0})));
        }
        if (off <= 1e-14L * most) break;
        h /= 2;
    }
    return h;
}

static void move(Real time) {
    Part t = time;
    Real at = sum(z, ORDER, time), by = rate(z, ORDER, time);
    z[0] = at, z[1] = by;
    for (int n = 0; n < count; n++) {
        Part s = 0, v = 0;
        for (int k = ORDER; k >= 1; k--) s = s * t + y[k][n], v = v * t + k * y[k][n];
        y[0][n] += s * t, y[1][n] = v;
    }
}

/* The first time in (0, h] at which the compression turns or comes to its largest again; h if none. */
static Real event(Real h, int *found) {
    Real low = 0, high = h;
    *found = 0;
    for (int k = 1; k <= LOOKS && !*found; k++) {
        high = h * k / LOOKS;
        *found = back ? sum(x, ORDER, high) > largest : rate(x, ORDER, high) < 0;
        if (!*found) low = high;
    }
    if (!*found) return h;
    for (int k = 0; k < 80; k++) {
        Real middle = (low + high) / 2;
        int beyond = back ? sum(x, ORDER, middle) > largest : rate(x, ORDER, middle) < 0;
        if (beyond) high = middle; else low = middle;
    }
    return high;
}

/* The free motion after a time; its rate too. The amplitudes: y = e^{-dt}(p cos wt + q sin wt). */
static Real away[2][MOST], turn[MOST], decay[MOST];
static Real flight(Real t, Real *velocity) {
    Real at = z[0] + z[1] * t;
    *velocity = z[1];
    for (int n = 0; n < count; n++) {
        Real c = cosl(turn[n] * t), s = sinl(turn[n] * t), e = expl(-decay[n] * t);
        Real p = away[0][n], q = away[1][n];
        at += e * (p * c + q * s);
        *velocity += e * ((q * turn[n] - decay[n] * p) * c - (p * turn[n] + decay[n] * q) * s);
    }
    return at;
}

/* The next touch after the ball has left (s), or -1; and how near it came (m). */
static Real next_touch(Real *nearest) {
    Real bend = 0, far = 0;
    *nearest = HUGE_VALL;
    for (int n = 0; n < count; n++) {
        decay[n] = friction[n] / 2;
        turn[n] = sqrtl(square[n] - decay[n] * decay[n]);
        away[0][n] = y[0][n];
        away[1][n] = (y[1][n] + decay[n] * y[0][n]) / turn[n];
        Real size = hypotl(away[0][n], away[1][n]);
        far += size;
        bend += size * square[n];
    }
    Real t = FIRST, v;
    while (t < 3 * fmaxl(GONE * scale / speed, LATE)) {
        Real at = flight(t, &v);
        if (at > 0) return t + FIRST;
        if (z[1] < 0 && z[0] + z[1] * t + far < 0) return -1;
        if (-at < 1e-17L * scale && v > 0) {
            t += FIRST;
            continue;
        }
        /* at + v s + bend s^2/2 = 0 comes before any touch. */
        Real root = sqrtl(v * v - 2 * bend * at);
        Real by = v > 0 ? -2 * at / (v + root) : (root - v) / bend;
        if (bend == 0) by = v > 0 ? -at / v : 1;
        if (v > -1e-3L * speed && v < 1e-3L * speed) *nearest = fminl(*nearest, -at);
        t += fmaxl(by, 1e-16L);
    }
    return t;
}

static void free_to(Real t) {
    for (int n = 0; n < count; n++) {
        Real c = cosl(turn[n] * t), s = sinl(turn[n] * t), e = expl(-decay[n] * t);
        Real p = away[0][n], q = away[1][n];
        y[0][n] = e * (p * c + q * s);
        y[1][n] = e * ((q * turn[n] - decay[n] * p) * c - (p * turn[n] + decay[n] * q) * s);
    }
    z[0] += z[1] * t;
}

int main(void) {
    Real restitution;
    while (scanf("%d %Lf %Lf %Lf %Lf %Lf %Lf", &count, &inverse_mass, &rest, &stiffness, &loading,
                 &restitution, &speed) == 7) {
        if (count > MOST) return 1;
        Real fastest = 0;
        for (int n = 0; n < count; n++) {
            Part omega, ratio;
            if (scanf("%lf %lf %lf", &omega, &ratio, &gain[n]) != 3) return 1;
            square[n] = omega * omega, friction[n] = 2 * ratio * omega;
            fastest = fmaxl(fastest, omega);
            y[0][n] = y[1][n] = 0;
        }
        unloading = (1 + loading) / (restitution * restitution) - 1;
        Real energy = speed * speed / inverse_mass / 2;
        scale = powl((1 + loading) * energy / stiffness, 1 / (1 + loading));
        /* So little time that the force does nothing. */
        z[0] = speed * FIRST, z[1] = speed;
        largest = back = 0;
        int touches = 0, reloads = 0, ends = 0;
        Real first = NAN, touching = 0, lost = 0, slack = HUGE_VALL, damped = 0;
        while (!ends && ++touches < 10000) {
            back = 0;
            Real dip = HUGE_VALL;
            for (long steps = 0;; steps++) {
                series();
                if (steps > 400000 || !(x[0] > 0)) {
                    ends = 2;
                    break;
                }
                if (back && x[0] < 1e-10L * largest && x[1] < 0) break;
                Real h = reach(fastest);
                for (int k = 0; k < 60 && !(sum(x, ORDER, h) > 0); k++) h /= 2;
                int found;
                h = event(h, &found);
                if (back) {
                    /* how near it comes to its largest, or to nothing, without getting there */
                    Real before = rate(x, ORDER, 0), after = rate(x, ORDER, h);
                    if (before > 0 && after <= 0 && !found)
                        slack = fminl(slack, (largest - sum(x, ORDER, h)) / largest);
                    if (before < 0 && after >= 0)
                        dip = fminl(dip, sum(x, ORDER, h) / largest);
                }
                move(h);
                touching += h;
                if (found && !back) {
                    largest = split(z[0] + total(y[0]));
                    back = 1;
                } else if (found) {
                    back = 0;
                    reloads++;
                }
            }
            slack = fminl(slack, dip);
            if (ends) break;
            Real top = stiffness * powl(largest, loading) * largest;
            if (touches == 1) first = (speed - z[1]) / inverse_mass;
            lost += top * (1 / (1 + loading) - 1 / (1 + unloading));
            largest = 0;
            /* the ball has left: what is touched is put to zero */
            z[0] = -total(y[0]);
            Real nearest, t = next_touch(&nearest);
            slack = fminl(slack, nearest / scale);
            Real limit = fmaxl(GONE * scale / speed, LATE);
            if (t > limit / 2 && t < limit * 2) ends = 2;
            else if (t < 0 || t >= limit) ends = 1;
            else {
                free_to(t);
                Real closing = z[1] + total(y[1]);
                if (!(z[0] + total(y[0]) > 0)) z[0] = fmaxl(closing * FIRST, LDBL_MIN) - total(y[0]);
            }
        }
        Real left = z[1] * z[1] / inverse_mass / 2 + lost;
        for (int n = 0; n < count; n++) {
            if (friction[n] > 0) damped = NAN;
            if (gain[n] > 0) left += (y[1][n] * y[1][n] + square[n] * y[0][n] * y[0][n]) / gain[n] / 2;
        }
        Real impulse = (speed - z[1]) / inverse_mass;
        if (ends != 1) impulse = NAN;
        printf("%.20Le %.20Le %.12Le %d %d %.2Le %.2Le\n", impulse, first, touching, touches, reloads,
               left / energy - 1 + damped, slack);
        fflush(stdout);
    }
    return 0;
}
