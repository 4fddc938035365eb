// For the leak sanitizer only: Fontconfig, which Cairo asks for a font, keeps a few hundred bytes
// of patterns until the process ends and offers no call that frees them. Leaks of our own still
// count.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GAIT_LEAKS_ARE_WATCHED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(GAIT_LEAKS_ARE_WATCHED)

extern "C" {
__attribute__((visibility("default"))) const char* __lsan_default_suppressions();
__attribute__((visibility("default"))) const char* __lsan_default_options();
}

const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
const char* __lsan_default_options() { return "print_suppressions=0"; }  // stderr is ours

#endif
