/* Statistics of samples: quantiles, Student's t distribution, confidence intervals of means and of
   differences of means, and numbers of runs that are needed. Shares and probabilities are from 0
   to 1. Used for reports, sweeps and claims; nothing of it enters a simulation. */
#ifndef JOX_BASE_STATISTICS_H
#define JOX_BASE_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/* Returns the quantile `q` of values, linear between ranks; sorts the array. NAN if there are none
   or one of them is NAN. */
double jox_quantile(double *values, size_t count, double q);

/* Student's t distribution with `degrees` of freedom, which need not be whole: the probability that
   |T| >= t; and its inverse, the t with |T| < t at a probability `share`. */
double jox_student_tail(double t, double degrees);
double jox_student_t(double degrees, double share);

/* Mean and standard deviation of a sample (n - 1 in the denominator; NAN if n < 2). */
typedef struct JoxMoments {
    double mean, deviation;
    size_t count;
} JoxMoments;
JoxMoments jox_moments(const double *values, size_t count);
/* Returns half the width of the confidence interval of the mean, at a confidence `share`, by
   Student's t; NAN if n < 2. */
double jox_mean_bound(const JoxMoments *moments, double share);

/* The difference of two means, b - a, with its confidence interval. Unknown numbers are NAN. */
typedef struct JoxEffect {
    double difference, low, high;
    double p; /* p-value, two-sided: probability of such a difference if the means are equal */
    double deviation; /* paired: standard deviation of the differences; else sqrt of the mean
                         variance */
    double degrees;   /* degrees of freedom; not whole for unpaired samples (Welch) */
    size_t pairs;     /* number of pairs; 0: not paired */
    size_t a, b;      /* number of values of each sample */
} JoxEffect;
/* Compares paired values, as of runs with the same seed, by Student's t of the differences. */
JoxEffect jox_effect_paired(const double *a, const double *b, size_t count, double share);
/* Compares two independent samples by Welch's t, which does not assume equal variances. */
JoxEffect jox_effect_apart(const double *a, size_t a_count, const double *b, size_t b_count,
                           double share);
/* Replaces the interval by one of the percentile bootstrap (Efron 1979): quantiles of the
   difference of means over `resamples` samples drawn with replacement (of pairs, if the effect is
   paired). The same arguments always give the same interval. */
void jox_effect_bootstrap(JoxEffect *effect, const double *a, const double *b, uint32_t resamples,
                          double share);
/* Returns the number of runs per side that are needed to find such an effect different from zero
   with a probability `power`, at a confidence `share`: the least n with |d| / (s sqrt(k / n)) >=
   t(share) + t(power), where k is 1 for pairs, else 2. 0: no number is known, since the difference
   is zero or its deviation unknown. */
size_t jox_effect_runs(const JoxEffect *effect, double share, double power);

/* Returns the rank, from 1, of the least of `count` values that is greater than a share `q` of
   them; 0: there is none. IMO MSC.1/Circ.1533 defines its 95 % evacuation time by this rule. */
size_t jox_rank_above(size_t count, double q);
/* Returns the rank of the least value that is an upper bound of the true quantile `q` with a
   probability of at least `share`, for any distribution (Wilks 1941); 0: there are too few
   values. */
size_t jox_rank_bound(size_t count, double q, double share);
/* Returns the least number of values of which the greatest is such a bound. */
size_t jox_rank_runs(double q, double share);

#endif
