/// @file sanitized.h
/// IS_SANITIZED: 1 under a sanitizer with a malloc of its own, which a test must not replace. gcc and clang say so each in
/// its own way.
#ifndef JN_TEST_SANITIZED_H
#define JN_TEST_SANITIZED_H

#ifndef __has_feature
	#define __has_feature(name) 0 // gcc
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
	#define IS_SANITIZED 1
#elif __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
	#define IS_SANITIZED 1
#else
	#define IS_SANITIZED 0
#endif

#endif
