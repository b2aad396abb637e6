// Linked into every program under the address sanitizer, to ignore leaks of other libraries. Assimp leaks when it
// rejects a damaged file; Vulkan drivers and layers keep memory until the end. Suppressions match names of loaded
// libraries only, so dlclose() does nothing.
#define WEFT_SEEN_BY_ALL extern "C" __attribute__((visibility("default")))

WEFT_SEEN_BY_ALL int dlclose(void*) {
    return 0;
}

WEFT_SEEN_BY_ALL const char* __lsan_default_suppressions() {
    return "leak:libassimp\nleak:libvulkan\nleak:libVkLayer\nleak:libLLVM\n";
}

WEFT_SEEN_BY_ALL const char* __lsan_default_options() {
    return "print_suppressions=0";
}
