#include "gltf/context.h"

#include <algorithm>

#include "base/bytes_text.h"
#include "base/memory_budget.h"

namespace facet::gltf {
namespace {

constexpr const char* kSceneCharge = "the scene";

}  // namespace

void Context::Charge(std::size_t count, std::size_t size_each, const Place& where) {
  constexpr std::size_t kSmall = std::size_t(256) << 20, kUnfolding = 1024;
  const std::size_t bound = kSmall + report.file_bytes * kUnfolding;
  if (size_each != 0 && count > (bound - charged_ - kept_) / size_each) {
    Fail(where, "the scene needs more memory than " + BytesText(double(bound)) + ", which so small a file never should",
         "is it made to do harm?", ErrorCode::OutOfMemory);
  }
  MemoryBudget::Current().Charge(count, size_each, kSceneCharge, where.Full());
  charged_ += count * size_each;
}

void Context::KeepSince(std::size_t before) {
  kept_ += charged_ - before;
  charged_ = before;
}

void Context::GiveBack(std::size_t charged_before) {
  if (charged_ <= charged_before) return;
  MemoryBudget::Current().Release(charged_ - charged_before, kSceneCharge);
  charged_ = charged_before;
}

const ExtensionUse* Context::FindExtension(std::string_view name) const {
  const auto& uses = report.extensions;  // sorted
  const auto found =
      std::lower_bound(uses.begin(), uses.end(), name,
                       [](const ExtensionUse& use, std::string_view wanted) { return use.name < wanted; });
  return found != uses.end() && found->name == name ? &*found : nullptr;
}

bool Context::IsUsed(std::string_view extension) const { return FindExtension(extension) != nullptr; }

bool Context::IsRequired(std::string_view extension) const {
  const ExtensionUse* const use = FindExtension(extension);
  return use != nullptr && use->required;
}

}  // namespace facet::gltf
