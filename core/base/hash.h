/* A 64-bit hash of simulation state (fast, not cryptographic), and SHA-256 of input files. */
#ifndef JOX_BASE_HASH_H
#define JOX_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

typedef struct JoxHash {
    uint64_t state;
} JoxHash;

JoxHash jox_hash_begin(void);
/* Adds `size` bytes; the result depends on order and content only. */
void jox_hash_add(JoxHash *hash, const void *data, size_t size);
uint64_t jox_hash_end(const JoxHash *hash);

/* SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits and a NUL. */
void jox_sha256_hex(const void *data, size_t size, char out[65]);

#endif
