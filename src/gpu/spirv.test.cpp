#include "gpu/spirv.h"

#include "base/temporary_folder.test.h"
#include "gpu/test_device.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <random>
#include <set>

namespace weft::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

// Words at the end of mapped memory, so that reading past them crashes.
class AtTheEdge {
  public:
    explicit AtTheEdge(std::span<const std::uint32_t> words) {
        const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
        const std::size_t inside = (words.size_bytes() + page - 1) / page * page;
        size_ = inside + page;
        memory_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        auto* bytes = static_cast<std::byte*>(memory_);
        ::mprotect(bytes + inside, page, PROT_NONE);
        std::byte* begin = bytes + inside - words.size_bytes();
        if (!words.empty()) std::memcpy(begin, words.data(), words.size_bytes());
        words_ = {reinterpret_cast<const std::uint32_t*>(begin), words.size()};
    }
    ~AtTheEdge() { ::munmap(memory_, size_); }
    AtTheEdge(const AtTheEdge&) = delete;
    AtTheEdge& operator=(const AtTheEdge&) = delete;
    std::span<const std::uint32_t> words() const { return words_; }

  private:
    void* memory_ = nullptr;
    std::size_t size_ = 0;
    std::span<const std::uint32_t> words_;
};

// How often each result of the module is decorated with NoContraction, and the results of sums and products of floats.
struct Decorated {
    std::map<std::uint32_t, int> times;
    std::set<std::uint32_t> arithmetic;
    std::set<std::uint32_t> ops;
};
Decorated decorated_in(const Words& words) {
    Decorated found;
    const std::set<std::uint32_t> arithmetic = {127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
        const std::uint32_t op = words[at] & 0xffff;
        if (op == 71 && words[at + 2] == 42) ++found.times[words[at + 1]];
        const bool function = op == 12 && (words[at + 4] == 46 || words[at + 4] >= 66);  // FMix, Length, Cross
        if (arithmetic.count(op) || function) found.arithmetic.insert(words[at + 2]), found.ops.insert(op);
    }
    return found;
}

TEST(Spirv, tells_what_a_shader_declares) {
    const auto shader = reflect(test_shader("bindings"));
    ASSERT_TRUE(shader.ok()) << shader.error().message();
    EXPECT_EQ(shader->push_constants, 28u) << "a vec3 begins at 16";
    EXPECT_EQ(shader->workgroup, (std::array<std::uint32_t, 3>{8, 1, 2}));
    EXPECT_EQ(shader->workgroup_constants[0], std::nullopt);
    EXPECT_EQ(shader->workgroup_constants[1], 4u);
    EXPECT_EQ(shader->specialization, (std::vector<std::uint32_t>{0, 2, 4}));
    ASSERT_EQ(shader->bindings.size(), 3u);
    const std::tuple<std::uint32_t, std::uint32_t, bool> expected[] = {{0, 0, false}, {0, 1, true}, {1, 3, false}};
    for (std::size_t i = 0; i < 3; ++i) {
        const ShaderBinding& one = shader->bindings[i];
        EXPECT_EQ(std::tuple(one.set, one.binding, one.uniform), expected[i]) << i;
    }
}

TEST(Spirv, tells_what_a_shader_without_bindings_declares) {
    const auto shader = reflect(test_shader("arithmetic"));
    ASSERT_TRUE(shader.ok()) << shader.error().message();
    EXPECT_EQ(shader->push_constants, 28u);
    EXPECT_TRUE(shader->bindings.empty());
    EXPECT_EQ(shader->workgroup_constants[0], 0u);
}

TEST(Spirv, what_is_no_shader_is_an_error) {
    const Words good(test_shader("arithmetic").words.begin(), test_shader("arithmetic").words.end());
    std::map<std::string, Words> bad = {{"empty", {}}, {"head alone", {good.begin(), good.begin() + 5}}};
    bad["other magic"] = good;
    bad["other magic"][0] = 0x03022307;
    bad["no length"] = good;
    bad["no length"][5] &= 0xffff;
    bad["beyond the end"] = good;
    bad["beyond the end"].back() += 1u << 16;
    bad["endless ids"] = good;
    bad["endless ids"][3] = 0xffffffff;
    bad["noise"].resize(300);
    std::mt19937 random(3);
    for (std::uint32_t& word : bad["noise"]) word = static_cast<std::uint32_t>(random());
    for (const auto& [why, words] : bad) {
        const auto shader = reflect({"bad", words});
        ASSERT_FALSE(shader.ok()) << why;
        EXPECT_EQ(shader.error().where, "bad") << why;
        EXPECT_EQ(shader.error().fault, Fault::machine) << why;
        EXPECT_NE(shader.error().what.find("invalid SPIR-V"), std::string::npos) << shader.error().what;
        EXPECT_EQ(with_exact_arithmetic(words).size(), words.size()) << why;
    }
}

TEST(Spirv, every_sum_and_product_is_exact_and_nothing_else_has_changed) {
    const Shader& shader = test_shader("arithmetic");
    const Words before(shader.words.begin(), shader.words.end()), after = with_exact_arithmetic(shader.words);
    const Decorated found = decorated_in(after);
    EXPECT_GE(found.ops.size(), 10u) << "the shader should have most kinds";
    for (const std::uint32_t op : {12, 129, 131, 133, 142, 143, 144, 145, 147, 148})
        EXPECT_TRUE(found.ops.count(op)) << op;
    ASSERT_EQ(found.times.size(), found.arithmetic.size());
    for (const auto& [id, times] : found.times) {
        EXPECT_EQ(times, 1) << id;
        EXPECT_TRUE(found.arithmetic.count(id)) << id;
    }
    // Without the decorations, the module is unchanged.
    Words rest(after.begin(), after.begin() + 5);
    for (std::size_t at = 5; at < after.size(); at += after[at] >> 16) {
        if ((after[at] & 0xffff) == 71 && after[at + 2] == 42) continue;
        rest.insert(rest.end(), after.begin() + static_cast<std::ptrdiff_t>(at),
                    after.begin() + static_cast<std::ptrdiff_t>(at + (after[at] >> 16)));
    }
    EXPECT_EQ(rest, before);
    EXPECT_EQ(with_exact_arithmetic(after), after) << "a second time there is nothing to do";
}

TEST(Spirv, what_is_decorated_already_is_not_decorated_twice) {
    const Shader& shader = test_shader("exact");
    const Decorated before = decorated_in({shader.words.begin(), shader.words.end()});
    const Decorated after = decorated_in(with_exact_arithmetic(shader.words));
    EXPECT_GT(before.times.size(), 0u) << "the shader should say precise";
    EXPECT_EQ(after.times.size(), after.arithmetic.size());
    for (const auto& [id, times] : after.times) EXPECT_EQ(times, 1) << id;
}

TEST(Spirv, exact_modules_are_valid) {
    const TemporaryFolder folder;
    for (const char* name : {"arithmetic", "bindings", "exact"}) {
        const Words words = with_exact_arithmetic(test_shader(name).words);
        const std::string file = (folder.path() / name).string();
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
        const std::string command = std::string(WEFT_SPIRV_VAL " --target-env vulkan1.2 ") + file;
        EXPECT_EQ(std::system(command.c_str()), 0) << name;
    }
}

TEST(Spirv, nothing_is_read_beyond_the_end_of_damaged_words) {
    std::mt19937 random(11);
    for (const char* name : {"arithmetic", "bindings", "exact"}) {
        const Words good(test_shader(name).words.begin(), test_shader(name).words.end());
        for (std::size_t size = 0; size <= good.size(); ++size) {
            const AtTheEdge cut(std::span<const std::uint32_t>(good).first(size));
            const Words exact = with_exact_arithmetic(cut.words());
            EXPECT_GE(exact.size(), size);
            if (size < good.size()) {
                EXPECT_FALSE(reflect({"cut", cut.words()}).ok()) << name << ' ' << size;
            }
        }
        for (int round = 0; round < 2000; ++round) {
            Words words = good;
            for (unsigned flips = 1 + random() % 3; flips > 0; --flips)
                words[random() % words.size()] ^=
                    round % 2 ? 1u << random() % 32 : static_cast<std::uint32_t>(random());
            const AtTheEdge damaged(words);
            EXPECT_GE(with_exact_arithmetic(damaged.words()).size(), words.size());
        }
    }
}

// Damages only the outline of a module: the library that reads the rest trusts compilers, and so do drivers.
TEST(Spirv, a_damaged_frame_is_an_error_and_no_crash) {
    const Words good(test_shader("bindings").words.begin(), test_shader("bindings").words.end());
    std::vector<std::size_t> begins;
    for (std::size_t at = 5; at < good.size(); at += good[at] >> 16) begins.push_back(at);
    for (const std::size_t at : begins) {
        Words words = good;
        words[at] = (words[at] & 0xffff) | 0xffff0000u;
        const AtTheEdge damaged(words);
        EXPECT_FALSE(reflect({"damaged", damaged.words()}).ok()) << at;
    }
}

}  // namespace
}  // namespace weft::gpu
