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
  explicit KeyGuard(const std::string& file) : file_(file) {}

  bool start_object(std::size_t) override { return seen_.emplace_back(), true; }
  bool end_object() override { return seen_.pop_back(), true; }
  bool key(std::string& name) override {
    constexpr std::size_t kMostKeys = 1000;
    if (!seen_.back().insert(name).second) Fail("the key " + Quoted(name) + " is twice in one object");
    if (seen_.back().size() > kMostKeys) Fail("an object has more than " + std::to_string(kMostKeys) + " keys");
    return true;
  }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  // ParseStrictJson() reports syntax errors, with line and column.
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

 private:
  void Fail(const std::string& message) const { throw Error(ErrorCode::InvalidInput, message, file_); }

  const std::string& file_;
  std::vector<std::set<std::string>> seen_;
};

}  // namespace

StrictJson ParseStrictJson(const std::string& text, const std::string& file) {
  gltf::RefuseForeignJson(text, file);
  if (IsJsonDeeperThan(text, kMaxJsonDepth)) {
    throw Error(ErrorCode::InvalidInput, "JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels",
                file);
  }
  try {
    KeyGuard guard(file);
    Json::sax_parse(text, &guard);
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::string before = text.substr(0, error.byte == 0 ? 0 : error.byte - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    std::string what = Printable(error.what());
    what.erase(0, what.find(": ") + 2);  // removes the position in the parser's message
    throw Error(ErrorCode::InvalidInput, what, file + ":" + std::to_string(line) + ":" + std::to_string(column));
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::InvalidInput, Printable(error.what()), file);
  }
}

}  // namespace facet
