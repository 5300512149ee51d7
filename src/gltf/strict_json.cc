#include "gltf/strict_json.h"

#include <set>
#include <vector>

#include "base/json_bounds.h"
#include "gltf/recognize.h"

namespace facet {
namespace {

using Json = StrictJson;

// Checks the text before it is parsed. Refuses duplicate keys, of which the parser would silently keep the last, and
// objects with very many keys, for which the parser takes quadratic time.
class KeyGuard : public nlohmann::json_sax<Json> {
 public:
  KeyGuard(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  bool start_object(std::size_t) override { return Open(false); }
  bool end_object() override { return open_.pop_back(), true; }
  bool start_array(std::size_t) override { return Open(true); }
  bool end_array() override { return open_.pop_back(), true; }
  bool key(std::string& name) override {
    constexpr std::size_t kMostKeys = 1000;
    Level& object = open_.back();
    if (object.keys.size() == kMostKeys) Fail("has more than " + std::to_string(kMostKeys) + " keys", open_.size() - 1);
    object.key = name;
    if (!object.keys.insert(name).second) Fail("the key is twice in one object", open_.size());
    return true;
  }
  bool null() override { return Value(); }
  bool boolean(bool) override { return Value(); }
  bool number_integer(number_integer_t) override { return Value(); }
  bool number_unsigned(number_unsigned_t) override { return Value(); }
  bool number_float(number_float_t, const std::string&) override { return Value(); }
  bool string(std::string&) override { return Value(); }
  bool binary(binary_t&) override { return Value(); }
  bool parse_error(std::size_t byte, const std::string&, const Json::exception& error) override {
    const std::string before = text_.substr(0, byte == 0 ? 0 : byte - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    std::string what = Printable(error.what());
    what.erase(0, what.find("] ") + 2);                                          // the exception's number
    if (what.starts_with("parse error at")) what.erase(0, what.find(": ") + 2);  // the position
    throw Error(ErrorCode::InvalidInput, what, file_ + ":" + std::to_string(line) + ":" + std::to_string(column));
  }

 private:
  // An object or array that has begun and not ended.
  struct Level {
    bool is_array;
    std::size_t index;  // in an array, of the next value
    std::string key;    // in an object, the last one
    std::set<std::string> keys;
  };

  bool Value() {
    if (!open_.empty()) ++open_.back().index;
    return true;
  }
  bool Open(bool is_array) {
    open_.push_back({is_array, 0, {}, {}});
    if (open_.size() > 1) ++open_[open_.size() - 2].index;
    return true;
  }
  // `depth`: of the JSON pointer.
  [[noreturn]] void Fail(const std::string& message, std::size_t depth) const {
    Json::json_pointer pointer;
    for (std::size_t i = 0; i < depth; ++i) {
      if (open_[i].is_array) {
        pointer /= open_[i].index - 1;
      } else {
        pointer /= open_[i].key;
      }
    }
    throw Error(ErrorCode::InvalidInput, message,
                pointer.empty() ? file_ : file_ + ": " + Printable(pointer.to_string()));
  }

  const std::string& text_;
  const std::string& file_;
  std::vector<Level> open_;
};

}  // namespace

StrictJson ParseStrictJson(const std::string& text, const std::string& file) {
  gltf::RefuseForeignJson(text, file);
  if (IsJsonDeeperThan(text, kMaxJsonDepth)) {
    throw Error(ErrorCode::InvalidInput, "JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels",
                file);
  }
  KeyGuard guard(text, file);
  Json::sax_parse(text, &guard);
  return Json::parse(text);
}

}  // namespace facet
