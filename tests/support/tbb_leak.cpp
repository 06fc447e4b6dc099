// For tests that end right after parallel work of several threads. A worker of TBB that still looks
// for work when its arena's last observer (radiosity::LowPriority) is taken away keeps a reference
// to TBB's own record of it, 40 bytes for each thread of the viewer, which is not given back if the
// process ends before the worker looks again. Nothing of ours can be waited for.

// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:tbb::detail::r1::observe\n"; }
