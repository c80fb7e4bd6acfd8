#pragma once
/// The attribute PSEUDORIGID_FLATTEN, which inlines all calls in a function. The attribute is empty under sanitizers,
/// because the checks and the compile times of sanitizers grow with the inlined code.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PSEUDORIGID_FLATTEN
#else
#define PSEUDORIGID_FLATTEN [[gnu::flatten]]
#endif
