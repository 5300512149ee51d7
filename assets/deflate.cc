#include "deflate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>

namespace facet::assets {
namespace {

constexpr int kMinMatch = 3, kMaxMatch = 258, kWindow = 32768, kMaxChain = 128;
constexpr std::size_t kTokensPerBlock = 32768;

constexpr std::array<int, 29> kLengthBase = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                             31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<int, 29> kLengthExtra = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                              2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<int, 30> kDistanceBase = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                               33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                               1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr std::array<int, 30> kDistanceExtra = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

struct Token {
  int literal_or_length = 0;  // a byte where distance is 0
  int distance = 0;
};

template <std::size_t N>
int SymbolOf(const std::array<int, N>& base, int value) {
  return int(std::upper_bound(base.begin(), base.end(), value) - base.begin()) - 1;
}

class BitWriter {
 public:
  explicit BitWriter(std::vector<std::uint8_t>& out) : out_(out) {}
  void Write(std::uint32_t value, int count) {  // least significant bit first
    for (int i = 0; i < count; ++i) {
      current_ = std::uint8_t(current_ | ((value >> i) & 1u) << used_);
      if (++used_ == 8) Flush();
    }
  }
  void WriteCode(std::uint32_t code, int length) {  // most significant bit first
    for (int i = length - 1; i >= 0; --i) Write((code >> i) & 1u, 1);
  }
  void Flush() {
    if (used_ == 0) return;
    out_.push_back(current_);
    current_ = 0;
    used_ = 0;
  }

 private:
  std::vector<std::uint8_t>& out_;
  std::uint8_t current_ = 0;
  int used_ = 0;
};

// Greedy with one step of laziness over hash chains.
std::vector<Token> FindMatches(const std::vector<std::uint8_t>& data) {
  const int size = int(data.size());
  constexpr int kHashSize = 1 << 15;
  std::vector<int> head(kHashSize, -1), previous(data.size(), -1);
  const auto hash = [&](int i) {
    const std::uint32_t key = data[std::size_t(i)] | data[std::size_t(i) + 1] << 8 | data[std::size_t(i) + 2] << 16;
    return (key * 2654435761u) >> 17;
  };
  const auto insert = [&](int i) {
    if (i + kMinMatch > size) return;
    int& first = head[hash(i)];
    previous[std::size_t(i)] = first;
    first = i;
  };
  const auto longest = [&](int i) {
    Token best;
    if (i + kMinMatch > size) return best;
    const int limit = std::min(kMaxMatch, size - i);
    int chain = kMaxChain;
    for (int j = head[hash(i)]; j >= 0 && i - j <= kWindow && chain-- > 0; j = previous[std::size_t(j)]) {
      int length = 0;
      while (length < limit && data[std::size_t(j + length)] == data[std::size_t(i + length)]) ++length;
      if (length >= kMinMatch && length > best.literal_or_length) best = {length, i - j};
      if (length == limit) break;
    }
    return best;
  };
  std::vector<Token> tokens;
  Token here = longest(0);
  for (int i = 0; i < size;) {
    insert(i);
    const Token next = i + 1 < size ? longest(i + 1) : Token{};
    if (here.distance == 0 || next.literal_or_length > here.literal_or_length) {
      tokens.push_back({data[std::size_t(i)], 0});
      ++i;
      here = next;
      continue;
    }
    tokens.push_back(here);
    for (int k = 1; k < here.literal_or_length; ++k) insert(i + k);
    i += here.literal_or_length;
    here = i < size ? longest(i) : Token{};
  }
  return tokens;
}

// Huffman code lengths of at most `limit` bits; frequencies are flattened until the tree is that shallow.
std::vector<int> CodeLengths(std::vector<std::uint32_t> frequencies, int limit) {
  const int count = int(frequencies.size());
  std::vector<int> lengths(frequencies.size(), 0);
  int used = 0;
  for (std::uint32_t f : frequencies) used += f > 0;
  for (int i = 0; used < 2 && i < count; ++i) {  // a decoder wants a complete code
    if (frequencies[std::size_t(i)] == 0) frequencies[std::size_t(i)] = 1, ++used;
  }
  for (;;) {
    using Entry = std::pair<std::uint32_t, int>;  // frequency, node: ties go to the older node
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<int> parent(std::size_t(count), -1);
    for (int i = 0; i < count; ++i) {
      if (frequencies[std::size_t(i)] > 0) queue.push({frequencies[std::size_t(i)], i});
    }
    while (queue.size() > 1) {
      const Entry a = queue.top();
      queue.pop();
      const Entry b = queue.top();
      queue.pop();
      const int node = int(parent.size());
      parent.push_back(-1);
      parent[std::size_t(a.second)] = parent[std::size_t(b.second)] = node;
      queue.push({a.first + b.first, node});
    }
    int longest = 0;
    for (int i = 0; i < count; ++i) {
      lengths[std::size_t(i)] = 0;
      if (frequencies[std::size_t(i)] == 0) continue;
      for (int node = i; parent[std::size_t(node)] >= 0; node = parent[std::size_t(node)]) ++lengths[std::size_t(i)];
      longest = std::max(longest, lengths[std::size_t(i)]);
    }
    if (longest <= limit) return lengths;
    for (std::uint32_t& f : frequencies) f = (f + 1) / 2;
  }
}

// RFC 1951, section 3.2.2.
std::vector<std::uint32_t> CanonicalCodes(const std::vector<int>& lengths) {
  std::array<std::uint32_t, 17> next{};
  std::array<std::uint32_t, 17> counts{};
  for (int length : lengths) ++counts[std::size_t(length)];
  counts[0] = 0;
  for (std::size_t bits = 1; bits < next.size(); ++bits) next[bits] = (next[bits - 1] + counts[bits - 1]) << 1;
  std::vector<std::uint32_t> codes(lengths.size(), 0);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] > 0) codes[i] = next[std::size_t(lengths[i])]++;
  }
  return codes;
}

void WriteBlock(BitWriter& bits, const Token* begin, const Token* end, bool last) {
  std::vector<std::uint32_t> literal_counts(286, 0), distance_counts(30, 0);
  literal_counts[256] = 1;
  for (const Token* token = begin; token != end; ++token) {
    if (token->distance == 0) {
      ++literal_counts[std::size_t(token->literal_or_length)];
    } else {
      ++literal_counts[std::size_t(257 + SymbolOf(kLengthBase, token->literal_or_length))];
      ++distance_counts[std::size_t(SymbolOf(kDistanceBase, token->distance))];
    }
  }
  const std::vector<int> literal_lengths = CodeLengths(literal_counts, 15);
  const std::vector<int> distance_lengths = CodeLengths(distance_counts, 15);
  const auto literal_codes = CanonicalCodes(literal_lengths), distance_codes = CanonicalCodes(distance_lengths);

  // The two tables themselves are coded with a third code, without its run lengths: 316 numbers are little.
  std::vector<std::uint32_t> length_counts(19, 0);
  for (int length : literal_lengths) ++length_counts[std::size_t(length)];
  for (int length : distance_lengths) ++length_counts[std::size_t(length)];
  const std::vector<int> length_lengths = CodeLengths(length_counts, 7);
  const auto length_codes = CanonicalCodes(length_lengths);
  constexpr std::array<std::size_t, 19> kOrder = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

  bits.Write(last ? 1 : 0, 1);
  bits.Write(2, 2);
  bits.Write(286 - 257, 5);
  bits.Write(30 - 1, 5);
  bits.Write(19 - 4, 4);
  for (std::size_t symbol : kOrder) bits.Write(std::uint32_t(length_lengths[symbol]), 3);
  for (const auto* table : {&literal_lengths, &distance_lengths}) {
    for (int length : *table) bits.WriteCode(length_codes[std::size_t(length)], length_lengths[std::size_t(length)]);
  }
  for (const Token* token = begin; token != end; ++token) {
    if (token->distance == 0) {
      const std::size_t symbol = std::size_t(token->literal_or_length);
      bits.WriteCode(literal_codes[symbol], literal_lengths[symbol]);
      continue;
    }
    const std::size_t length = std::size_t(SymbolOf(kLengthBase, token->literal_or_length));
    bits.WriteCode(literal_codes[257 + length], literal_lengths[257 + length]);
    bits.Write(std::uint32_t(token->literal_or_length - kLengthBase[length]), kLengthExtra[length]);
    const std::size_t distance = std::size_t(SymbolOf(kDistanceBase, token->distance));
    bits.WriteCode(distance_codes[distance], distance_lengths[distance]);
    bits.Write(std::uint32_t(token->distance - kDistanceBase[distance]), kDistanceExtra[distance]);
  }
  bits.WriteCode(literal_codes[256], literal_lengths[256]);
}

}  // namespace

std::vector<std::uint8_t> DeflateZlib(const std::vector<std::uint8_t>& data) {
  std::vector<std::uint8_t> out = {0x78, 0xDA};
  BitWriter bits(out);
  const std::vector<Token> tokens = FindMatches(data);
  std::size_t begin = 0;
  do {
    const std::size_t end = std::min(tokens.size(), begin + kTokensPerBlock);
    WriteBlock(bits, tokens.data() + begin, tokens.data() + end, end == tokens.size());
    begin = end;
  } while (begin < tokens.size());
  bits.Flush();
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (std::uint8_t byte : data) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  const std::uint32_t sum = b << 16 | a;
  for (int shift : {24, 16, 8, 0}) out.push_back(std::uint8_t(sum >> shift));
  return out;
}

}  // namespace facet::assets
