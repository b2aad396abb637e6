// Linked into every program under the address sanitizer: memory that others lose is not ours to answer for. Assimp
// loses some when it gives up on a damaged file; Vulkan drivers and layers hold theirs to the end. What is unloaded
// has no name any more that a suppression could match, so nothing is unloaded.
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
