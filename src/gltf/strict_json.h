// JSON files of facet's own, such as manifests and material files: unlike in glTF, what is wrong in them is an error.
#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/printable.h"
#include "facet/error.h"

namespace facet {

using StrictJson = nlohmann::ordered_json;

// A value and its JSON pointer.
struct JsonValue {
  const StrictJson& json;
  StrictJson::json_pointer pointer;
  const std::string& file;

  JsonValue operator[](const std::string& key) const { return {json.at(key), pointer / key, file}; }
  bool Has(const char* key) const { return json.contains(key); }
  std::string Place() const { return file + ": " + Printable(pointer.to_string()); }

  [[noreturn]] void Fail(const std::string& message, const std::string& hint = {}) const {
    throw Error(ErrorCode::InvalidInput, message, pointer.empty() ? file : Place(), hint);
  }
  const JsonValue& Expect(bool good, const char* what) const {
    if (!good) Fail(std::string("is no ") + what);
    return *this;
  }
  const std::string& Text() const { return Expect(json.is_string(), "string").json.get_ref<const std::string&>(); }

  const JsonValue& ExpectObject(std::span<const char* const> keys) const {
    Expect(json.is_object(), "object");
    for (const auto& [key, ignored] : json.items()) {
      if (std::ranges::find(keys, key) == keys.end()) {
        std::string list;
        for (const char* known : keys) list += (list.empty() ? "" : ", ") + std::string(known);
        (*this)[key].Fail("unknown key", "use one of " + list);
      }
    }
    return *this;
  }
};

// Parses a file's text. Refuses duplicate keys. Throws Error(InvalidInput) with line and column. `file`: its name in
// messages. The caller must have charged JsonMemory() (base/json_bounds.h), twice.
StrictJson ParseStrictJson(const std::string& text, const std::string& file);

}  // namespace facet
