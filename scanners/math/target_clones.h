// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A function with three bodies, for AVX-512, for AVX2 and for any x86-64; the loader picks. Without FMA they compute
// the very same numbers, only more of them at a time. Sanitizers run before the loader's choice is ready, so they get
// one body.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define STANDPOINT_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define STANDPOINT_CLONES
#endif
