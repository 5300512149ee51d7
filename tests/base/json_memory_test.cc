// What JSON is charged is at least what the parser takes of the heap, at any moment. Every allocation of this program
// is counted, as the allocator rounds it.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "base/json_bounds.h"

namespace {

std::size_t g_now = 0, g_most = 0;
constexpr std::size_t kAllocatorsOwn = 8;  // before each piece

void* Allocate(std::size_t size) {
  void* const piece = std::malloc(size == 0 ? 1 : size);
  if (piece == nullptr) throw std::bad_alloc();
  g_now += malloc_usable_size(piece) + kAllocatorsOwn;
  g_most = std::max(g_most, g_now);
  return piece;
}

void Free(void* piece) {
  if (piece == nullptr) return;
  g_now -= malloc_usable_size(piece) + kAllocatorsOwn;
  std::free(piece);
}

}  // namespace

void* operator new(std::size_t size) { return Allocate(size); }
void* operator new[](std::size_t size) { return Allocate(size); }
void operator delete(void* piece) noexcept { Free(piece); }
void operator delete[](void* piece) noexcept { Free(piece); }
void operator delete(void* piece, std::size_t) noexcept { Free(piece); }
void operator delete[](void* piece, std::size_t) noexcept { Free(piece); }

namespace facet {
namespace {

// What parsing takes at its most, the values included.
template <class Json>
std::size_t TakenBy(const std::string& text) {
  const std::size_t before = g_now;
  g_most = g_now;
  const Json json = Json::parse(text);
  EXPECT_FALSE(json.is_discarded());
  return g_most - before;
}

// `in_order`: by the parser that keeps the order of keys as well, which compares each with all before it.
void ExpectCharged(const std::string& text, const std::string& what, bool in_order = true) {
  const std::uint64_t charged = JsonMemory(text);
  EXPECT_LE(TakenBy<nlohmann::json>(text), charged) << what << ", " << text.size() << " bytes";
  if (!in_order) return;
  EXPECT_LE(TakenBy<nlohmann::ordered_json>(text), 2 * charged) << what << ", " << text.size() << " bytes, in order";
}

std::string Repeated(const std::string& part, int count, const std::string& between = "") {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i > 0 ? between : "") + part;
  return text;
}

std::string List(const std::string& element, int count) { return '[' + Repeated(element, count, ",") + ']'; }

TEST(JsonMemory, IsAtLeastWhatOneValueTakes) {
  for (const char* text :
       {"0", "null", "true", "-1.5e300", "\"\"", "[]", "{}", "[[]]", "{\"\":{}}", "\"a\"", "\"\\u20ac\""}) {
    ExpectCharged(text, text);
  }
}

// Just beyond the sizes to which arrays and strings grow by doubling, where most is left unused or copied.
TEST(JsonMemory, IsAtLeastWhatWideListsTake) {
  for (const char* element : {"0", "1.5", "-7", "null", "[]", "{}", "\"\"", "\"a\"", "[0]", "[0,0]", "{\"\":0}", "[[]]",
                              "\"0123456789abcde\"", "\"0123456789abcdef\"", "\"0123456789abcdef0123456789abcdef\"",
                              "{\"a\":1,\"b\":2}", "{\"a\":{}}", "{\"0123456789abcdef\":\"0123456789abcdef\"}"}) {
    for (const int count : {1, 2, 3, 5, 9, 17, 33, 1000, 1025, 32769, 65536}) {
      ExpectCharged(List(element, count), std::string(element) + " x " + std::to_string(count));
    }
  }
}

TEST(JsonMemory, IsAtLeastWhatDeepValuesTake) {
  for (const int depth : {1, 2, 10, 127, 128}) {
    ExpectCharged(std::string(std::size_t(depth), '[') + std::string(std::size_t(depth), ']'), "lists");
    ExpectCharged(Repeated("{\"\":", depth) + "0" + std::string(std::size_t(depth), '}'), "objects");
    ExpectCharged(Repeated("[{\"a\":", depth) + "0" + Repeated("}]", depth), "both");
  }
  // Wide on every level, and deep in every element.
  ExpectCharged(List(std::string(60, '[') + std::string(60, ']'), 3000), "many deep lists");
  ExpectCharged(List(Repeated("{\"k\":", 60) + "1" + std::string(60, '}'), 3000), "many deep objects");
}

TEST(JsonMemory, IsAtLeastWhatWideObjectsTake) {
  for (const char* value : {"0", "\"\"", "[]", "{}", "\"0123456789abcdef\""}) {
    for (const int count : {1, 2, 3, 5, 9, 17, 33, 129, 1000, 20000}) {
      for (const std::size_t padding : {std::size_t(0), std::size_t(10), std::size_t(11), std::size_t(40)}) {
        std::string text = "{";
        for (int i = 0; i < count; ++i) {
          text += (i ? ",\"" : "\"") + std::to_string(i) + std::string(padding, 'k') + "\":" + value;
        }
        const std::string what = std::string(value) + " by key, " + std::to_string(count) + ", padding ";
        ExpectCharged(text + "}", what + std::to_string(padding), count <= 1000);
      }
    }
  }
}

// The parser keeps the bytes of the string or number that it reads, and those up to the next, in buffers that double.
TEST(JsonMemory, IsAtLeastWhatOneLongTokenTakes) {
  for (const int power : {4, 6, 10, 16, 20}) {
    for (const int more : {-2, -1, 0, 1, 2}) {
      const auto size = static_cast<std::size_t>((1 << power) + more);
      ExpectCharged('"' + std::string(size, 'x') + '"', "a string");
      ExpectCharged("[\"" + std::string(size, 'x') + "\",\"" + std::string(size, 'y') + "\"]", "two strings");
      ExpectCharged("{\"" + std::string(size, 'x') + "\":1}", "a key");
      ExpectCharged("[0." + std::string(size, '1') + "]", "a number");
      ExpectCharged('"' + Repeated("\\n", int(size / 2)) + '"', "escapes");
      ExpectCharged('[' + std::string(size, ' ') + ']', "spaces");
      ExpectCharged("[1" + std::string(size, '\n') + ",2]", "lines");
      ExpectCharged("[\"a\"," + Repeated("null,", int(size / 5)) + "0]", "literals");
    }
  }
}

// glTF as it is: random trees of everything.
class Trees {
 public:
  explicit Trees(unsigned seed) : random_(seed) {}
  std::string Make(int levels) {
    const auto kind = random_() % (levels > 0 ? 9 : 5);
    switch (kind) {
      case 0: return std::to_string(int(random_() % 100000) - 50000);
      case 1: return "0." + std::to_string(random_());
      case 2: return '"' + std::string(random_() % 40, 's') + '"';
      case 3: return "true";
      case 4: return random_() % 2 ? "[]" : "{}";
      default: break;
    }
    const int count = int(random_() % 7);
    std::string text = kind < 7 ? "[" : "{";
    for (int i = 0; i < count; ++i) {
      if (i > 0) text += ',';
      if (kind >= 7) text += '"' + std::string(random_() % 24, 'k') + std::to_string(i) + "\":";
      text += Make(levels - 1);
    }
    return text + (kind < 7 ? "]" : "}");
  }

 private:
  std::minstd_rand random_;
};

TEST(JsonMemory, IsAtLeastWhatMixedValuesTake) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const std::string tree = Trees(seed).Make(7);
    ExpectCharged(tree, "tree " + std::to_string(seed));
    ExpectCharged(List(tree, 20), "list of trees " + std::to_string(seed));
  }
}

// And it is no wild guess: a list of numbers, the most of what large files have, is not charged ten times what it
// takes.
TEST(JsonMemory, IsOfTheSizeOfWhatIsTaken) {
  for (const char* element : {"0.125", "{\"bufferView\":3,\"componentType\":5126,\"count\":24,\"type\":\"VEC3\"}",
                              "[0,1,2]", "\"a name of some length\""}) {
    const std::string text = List(element, 10000);
    EXPECT_LT(JsonMemory(text), 10 * TakenBy<nlohmann::json>(text)) << element;
  }
}

}  // namespace
}  // namespace facet
