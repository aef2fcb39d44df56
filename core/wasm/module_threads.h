/* The threads that scenes of the module use (module_threads.c). */
#ifndef JOX_WASM_MODULE_THREADS_H
#define JOX_WASM_MODULE_THREADS_H

#include "jostle_host.h"
#include "wasm/module.h"

/* Number of processors, which the host tells; what system calls answer (system.c). */
extern int jox_module_processors;
/* Number of threads, the caller's included. */
uint32_t jox_module_threads(void);
/* Runs loops on these threads; NULL: there is one thread. */
const JoJobs *jox_module_jobs(void);

#endif
