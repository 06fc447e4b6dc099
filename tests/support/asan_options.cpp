// Options of AddressSanitizer for programs that read damaged HDF5 files: the library asks for what
// a file says it needs, and copes with not getting it.

#if defined(__SANITIZE_ADDRESS__)
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
#endif
