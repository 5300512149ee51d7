// The medium behind a surface (KHR_materials_volume): a flat slab of the stated thickness. What comes through it is
// absorbed on its way (Beer and Lambert), whether it passes the surface straight or diffusely.

#if defined(FACET_MATERIAL_LOBES_VOLUME_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_VOLUME_INL_H_
#undef FACET_MATERIAL_LOBES_VOLUME_INL_H_
#else
#define FACET_MATERIAL_LOBES_VOLUME_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct VolumeInputs {
  T thickness{};         // metres; 0: a thin wall, behind which no medium begins
  Vec3<T> absorption{};  // per metre

  // The share of light that the way through the slab leaves.
  FACET_INLINE Vec3<T> Passing() const {
    const auto of = [&](T a) HWY_ATTR { return Exp(Max(-(a * thickness), T(-100.0f))); };
    return {of(absorption.x), of(absorption.y), of(absorption.z)};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
