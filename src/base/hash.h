/// @file hash.h
/// A fingerprint of bytes: FNV-1a of 128 bits (Fowler, Noll, Vo). For telling contents apart, not for security.
#ifndef JN_BASE_HASH_H
#define JN_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

__extension__ typedef unsigned __int128 JnHash;

static inline JnHash jn_hash_start(void) {
	return (JnHash)0x6c62272e07bb0142u << 64 | 0x62b821756295c58du;
}

static inline JnHash jn_hash_add(JnHash hash, const void* bytes, size_t count) {
	const JnHash prime = (JnHash)1 << 88 | 0x13b;
	const unsigned char* byte = bytes;
	for (size_t i = 0; i < count; ++i) hash = (hash ^ byte[i]) * prime;
	return hash;
}

/// 32 hexadecimal digits.
static inline void jn_hash_text(JnHash hash, char text[33]) {
	snprintf(text, 33, "%016llx%016llx", (unsigned long long)(hash >> 64), (unsigned long long)hash);
}

#endif
