#pragma once
/// PSEUDORIGID_FLATTEN before a function: all that it calls is inlined. Not under sanitizers: their checks multiply
/// with what is inlined, and compile times with them.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PSEUDORIGID_FLATTEN
#else
#define PSEUDORIGID_FLATTEN [[gnu::flatten]]
#endif
