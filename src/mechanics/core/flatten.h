#pragma once
/// PSEUDORIGID_FLATTEN before a function inlines all functions that it calls. It is off under sanitizers, whose checks
/// and compile times grow with the inlined code.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PSEUDORIGID_FLATTEN
#else
#define PSEUDORIGID_FLATTEN [[gnu::flatten]]
#endif
