/* How much of a long series a test goes through: all of it in a plain build, one of EFFORT_EACH in
   a build with sanitizers, which is ten times slower and looks for other faults. */
#ifndef JOSTLE_TESTS_EFFORT_H
#define JOSTLE_TESTS_EFFORT_H

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { EFFORT_EACH = 5 };
#else
enum { EFFORT_EACH = 1 };
#endif

#endif
