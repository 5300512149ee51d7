#include "fuzz/provenance.h"

#include "base/memory_budget.h"
#include "fuzz/fuzz.h"
#include "settings/provenance.h"
#include "settings/render_request.h"

namespace facet::fuzz {

void ReadSettingsOf(std::string_view bytes) {
  Try([&] {
    MemoryBudget budget(kMemoryLimit);
    const MemoryBudget::Scope scope(budget);
    const Provenance provenance = ReadProvenance(AsBytes(bytes), "picture.png");
    RenderRequest request;
    for (const auto& [name, text] : provenance.settings) SetOption(request, name, "facet:settings", text);
    RefuseContradictions(request);
    const auto spelled_out = SpelledOut(request);
    RenderRequest again;
    for (const auto& [name, text] : spelled_out) {
      try {
        SetOption(again, name, name, text);
      } catch (const Error& error) {
        Fail(std::string("settings that were written are not read: ") + error.what());
      }
    }
    Check(SpelledOut(again) == spelled_out, "settings that were written are read as others");
  });
}

}  // namespace facet::fuzz
