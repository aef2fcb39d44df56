/* Statistics of samples: quantiles, Student's distribution, intervals of means and of their
   differences, and how many runs an answer takes. Shares and probabilities are from 0 to 1. */
#ifndef JOX_BASE_STATISTICS_H
#define JOX_BASE_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/* The value that a share `q` of all lie below, linear between ranks; sorts them. NAN of none, and
   where one of them is NAN. */
double jox_quantile(double *values, size_t count, double q);

/* Student's distribution of so many degrees of freedom, which need not be whole. The probability
   that |T| is at least t, and the t that |T| is below with a probability `share`. */
double jox_student_tail(double t, double degrees);
double jox_student_t(double degrees, double share);

/* Mean and standard deviation of a sample (of n - 1; NAN of fewer than two). */
typedef struct JoxMoments {
    double mean, deviation;
    size_t count;
} JoxMoments;
JoxMoments jox_moments(const double *values, size_t count);
/* Half the width of the interval that holds the true mean with a probability `share`, by Student's
   t; NAN of fewer than two. */
double jox_mean_bound(const JoxMoments *moments, double share);

/* The difference of two means, b less a, with an interval of a probability `share`. */
typedef struct JoxEffect {
    double difference, low, high; /* NAN where it is not known */
    double p;         /* the probability of a difference as great or greater, if there were none */
    double deviation; /* of the pairs' differences; of two samples: the root of the mean of their
                         variances */
    double degrees;   /* of freedom; not whole of samples that are not paired (Welch) */
    size_t pairs;     /* 0: not paired */
    size_t a, b;      /* values of each */
} JoxEffect;
/* Of values that belong together, as those of one seed: Student's t of their differences. */
JoxEffect jox_effect_paired(const double *a, const double *b, size_t count, double share);
/* Of two samples: Welch's t, which does not take their variances to be equal. */
JoxEffect jox_effect_apart(const double *a, size_t a_count, const double *b, size_t b_count,
                           double share);
/* Replaces the interval by that between quantiles of the differences of means of samples drawn with
   replacement (percentile bootstrap, Efron 1979), of the pairs where it is paired. The numbers
   drawn depend on nothing but `resamples`. */
void jox_effect_bootstrap(JoxEffect *effect, const double *a, const double *b, uint32_t resamples,
                          double share);
/* How many runs of each side it takes until an effect of that size, with that spread, is found to
   differ from zero with a probability `power`, by an interval of `share`: the least n of which
   |d| / (s sqrt(k / n)) is at least t(share) + t(power), k = 1 of pairs and 2 else. 0: none would,
   as there is no difference, or nothing is known of its spread. */
size_t jox_effect_runs(const JoxEffect *effect, double share, double power);

/* The rank, from 1, of the least value that is higher than a share `q` of all of `count`; 0: there
   is none. IMO MSC.1/Circ.1533 takes the time that is higher than 95 % of all by this rule. */
size_t jox_rank_above(size_t count, double q);
/* The rank of the least value that the true quantile `q` lies below with a probability of at least
   `share`, whatever the distribution (Wilks 1941); 0: so few values bound it not. */
size_t jox_rank_bound(size_t count, double q, double share);
/* How many values there must be for one of them to bound it: the greatest does. */
size_t jox_rank_runs(double q, double share);

#endif
