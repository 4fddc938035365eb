/* Loaded before everything else (LD_PRELOAD): counts what the thread that asked for it allocates or
   frees between gait_watch(1) and gait_watch(0). Only for tests. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <execinfo.h>
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void* old);

static __thread int watching, seen, busy;

static void note(void) {
  if (!watching || busy) return;
  busy = 1;
  if (++seen <= 3) { /* where: the first few tell enough */
    void* frames[24];
    backtrace_symbols_fd(frames, backtrace(frames, 24), 2);
    if (write(2, "--\n", 3) < 0) seen += 0;
  }
  busy = 0;
}

void* malloc(size_t size) {
  note();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  note();
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  note();
  return __libc_realloc(old, size);
}
void* memalign(size_t alignment, size_t size) {
  note();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  note();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** made, size_t alignment, size_t size) {
  note();
  *made = __libc_memalign(alignment, size);
  return *made ? 0 : 12;
}
void free(void* old) {
  if (old) note();
  __libc_free(old);
}

/* Says how often since it was switched on. */
int gait_watch(int on) {
  const int count = seen;
  if (on) {
    void* frames[2];
    backtrace(frames, 2); /* its first call loads a library */
    seen = 0;
  }
  watching = on;
  return count;
}
