// Evaluates a material's textures and factors for a packet of fragments.

#if defined(FACET_SHADE_MATERIAL_VIEW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_MATERIAL_VIEW_INL_H_
#undef FACET_SHADE_MATERIAL_VIEW_INL_H_
#else
#define FACET_SHADE_MATERIAL_VIEW_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "material/read-inl.h"
#include "plan/frame_material.h"
#include "texture/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Samples textures for one packet of fragments. Textures that are sampled alike share their taps (texel addresses and
// weights).
template <class T>
class TextureReader {
 public:
  // `surface` must outlive the reader, and must not change until the next ReadAhead().
  FACET_INLINE explicit TextureReader(const Surface<T>& surface) : s_(surface) {}

  // Computes the taps of the material's first texture, and prefetches them in all textures that share them. Memory is
  // slow, so call this for a new surface some time before it is shaded.
  FACET_INLINE void ReadAhead(const FrameMaterial& m) {
    made_for_ = empty_ = nullptr;
    summed_count_ = 0;
    const TexturesOf all(m);
    for (int k = 0; k < all.count; ++k) {
      if (k == 0) Find(*all.textures[0]);
      const BoundTexture& texture = *all.textures[k];
      if (HaveSameTaps(*made_for_, texture) && !IsEmpty(texture, taps_)) PrefetchTexels(*texture.data, taps_);
    }
  }

  // Samples all textures of the material, those that share taps together. An emission texture that is empty there is
  // not read.
  FACET_INLINE void ReadAll(const FrameMaterial& m) {
    TexturesOf left(m);
    empty_ = nullptr;
    for (summed_count_ = 0; left.count > 0;) {
      Find(*left.textures[0]);
      const TextureData* together[kMaxSlots];
      const BoundTexture* emission = nullptr;
      int count = 0, others = 0;
      for (int k = 0; k < left.count; ++k) {
        const BoundTexture* texture = left.textures[k];
        if (!HaveSameTaps(*made_for_, *texture)) {
          left.textures[others++] = texture;
        } else if (texture->data->empty_cells.width > 0) {
          emission = texture;
        } else {
          summed_[summed_count_ + count] = texture;
          together[count++] = texture->data;
        }
      }
      if (count > 0) SumTexels(count, together, taps_, sums_ + summed_count_);
      summed_count_ += count;
      if (emission != nullptr && IsEmpty(*emission, taps_)) {
        empty_ = emission;
      } else if (emission != nullptr) {
        SumTexels<1, T>(&emission->data, taps_, sums_ + summed_count_);
        summed_[summed_count_++] = emission;
      }
      left.count = others;
    }
  }

  template <int kChannels>
  FACET_INLINE Vec4<T> Read(const BoundTexture& texture) {
    if (&texture == empty_) return {T(0.0f), T(0.0f), T(0.0f), T(0.0f)};
    for (int k = 0; k < summed_count_; ++k) {
      if (summed_[k] == &texture) return ChannelsOf<kChannels>(*texture.data, sums_[k]);
    }
    Find(texture);
    return ReadTexture<kChannels>(texture, taps_);
  }

  FACET_INLINE bool IsOf(const Surface<T>& surface) const { return &surface == &s_; }

 private:
  struct TexturesOf {
    const BoundTexture* textures[kMaxSlots];
    int count = 0;
    FACET_INLINE explicit TexturesOf(const FrameMaterial& m) {
      for (MaterialFeatures left = m.features & kTextureBits; left != 0; left &= left - 1) {
        textures[count++] = &m.textures[__builtin_ctzll(left)];
      }
    }
  };

  FACET_INLINE void Find(const BoundTexture& texture) {
    if (made_for_ != nullptr && HaveSameTaps(*made_for_, texture)) return;
    const int k = texture.uv_slot;
    MakeTextureTaps(texture, s_.uv[k], s_.duv_dx[k], s_.duv_dy[k], taps_);
    made_for_ = &texture;
  }

  const Surface<T>& s_;
  const BoundTexture* made_for_ = nullptr;
  TextureTaps<T> taps_;
  int summed_count_ = 0;
  const BoundTexture* summed_[kMaxSlots];  // the textures that ReadAll() has summed
  TexelSums<T> sums_[kMaxSlots];
  const BoundTexture* empty_ = nullptr;  // the texture that ReadAll() found to be empty
};

// The material as shading models see it. T is Float (lanes), float or double. The slots of a model that is not glTF's
// mean something else than glTF's, but for those of the base colour and of the normal texture: it shows only these to
// whoever does not Read() it by its own parameters.
template <class T>
class MaterialView {
 public:
  // `ahead`: a reader that may have prefetched for its surface; null: there is none.
  FACET_INLINE explicit MaterialView(const FrameMaterial& material, TextureReader<T>* ahead = nullptr)
      : m_(material), ahead_(ahead) {}

  FACET_INLINE ShadingModel Model() const { return m_.model; }
  FACET_INLINE bool Lit() const { return m_.Has(kLit); }
  FACET_INLINE bool Emits() const { return m_.parameters == nullptr && m_.Has(kEmission); }

  // Factor times texture times vertex colour: linear, straight alpha. The texture's alpha is ignored if the material is
  // opaque, as glTF demands; it may not even be stored.
  FACET_INLINE Vec4<T> BaseColor(const Surface<T>& s) const {
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    return BaseColor(s, textures);
  }

  FACET_INLINE T Alpha(const Surface<T>& s) const {
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    T alpha = T(m_.factors.base_color[3]) * s.color.w;
    return m_.ReadsCoverage() ? alpha * Coverage(textures) : alpha;
  }

  // The shading normal, unit: the interpolated normal, perturbed by the normal texture.
  FACET_INLINE Vec3<T> Normal(const Surface<T>& s) const {
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    return MappedNormal<T>(Source{m_, s, textures}, Slot::Normal, m_.factors.normal_scale);
  }

  FACET_INLINE Vec3<T> Emissive(const Surface<T>& s) const {
    if (m_.parameters != nullptr) return {T(0.0f), T(0.0f), T(0.0f)};
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    return ReadEmission<T>(Source{m_, s, textures});
  }

  // For models that are not glTF's. Calls body(source, base), with a Source as material/read-inl.h has it, and the base
  // colour as BaseColor() gives it.
  template <class Body>
  FACET_INLINE auto Read(const Surface<T>& s, const Body& body) const {
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    textures.ReadAll(m_);
    return body(Source{m_, s, textures}, BaseColor(s, textures));
  }

  // All inputs of the metallic-roughness model, or of the specular-glossiness model. `kPossible`: the lobes that are
  // read.
  template <MaterialFeatures kPossible = kAllLobes>
  FACET_INLINE MaterialInputs<T> Inputs(const Surface<T>& s) const {
    TextureReader<T> own(s);
    TextureReader<T>& textures = ReaderOf(s, own);
    // Only users' shaders ask for this of other models, and they ask for all lobes.
    constexpr bool kIsGltf = kPossible != kAllLobes;
    if constexpr (!kIsGltf) {
      if (m_.parameters != nullptr) return InputsOfOther(s, textures);
    }
    textures.ReadAll(m_);
    const Vec4<T> base = BaseColor<kIsGltf>(s, textures);
    const Source source{m_, s, textures};
    MaterialInputs<T> in = ReadInputs<T, kPossible>(source, base, m_.features);
    in.footprint_alpha2 = s.footprint_alpha2;
    if constexpr ((kPossible & kIor) != 0) {
      if (m_.model == ShadingModel::SpecularGlossiness) SetSpecularGlossiness(source, in);
    }
    return in;
  }

 private:
  // See material/read-inl.h.
  struct Source {
    const FrameMaterial& m;
    const Surface<T>& s;
    TextureReader<T>& textures;

    FACET_INLINE bool Has(MaterialFeatures feature) const { return m.Has(feature); }
    FACET_INLINE const MaterialFactors& Factors() const { return m.factors; }
    template <class Block>
    FACET_INLINE const Block& Parameters() const {
      return m.Parameters<Block>();
    }
    template <int kChannels>
    FACET_INLINE Vec4<T> Read(Slot slot) const {
      return textures.template Read<kChannels>(m.Texture(slot));
    }
    FACET_INLINE const Vec3<T>& Normal() const { return s.normal; }
    FACET_INLINE const Vec3<T>& InterpolatedNormal() const { return s.interpolated_normal; }
    FACET_INLINE const Vec4<T>& Tangent() const { return s.tangent; }
    FACET_INLINE UvFootprint<T> FirstUv() const {
      return {s.uv[m.first_uv_slot], s.duv_dx[m.first_uv_slot], s.duv_dy[m.first_uv_slot]};
    }
    FACET_INLINE T MetresPerUnit() const { return s.metres_per_unit; }
    FACET_INLINE T FootprintAlpha2() const { return s.footprint_alpha2; }
  };

  FACET_INLINE TextureReader<T>& ReaderOf(const Surface<T>& s, TextureReader<T>& own) const {
    return ahead_ != nullptr && ahead_->IsOf(s) ? *ahead_ : own;
  }

  // Of a model that is not glTF's: a rough dielectric of its base colour.
  HWY_NOINLINE MaterialInputs<T> InputsOfOther(const Surface<T>& s, TextureReader<T>& textures) const {
    const Vec4<T> base = BaseColor(s, textures);
    MaterialInputs<T> in;
    in.base_color = Xyz(base);
    in.alpha_coverage = base.w;
    in.metallic = T(0.0f);
    in.perceptual_roughness = T(1.0f);
    in.normal = MappedNormal<T>(Source{m_, s, textures}, Slot::Normal, m_.factors.normal_scale);
    in.occlusion = T(1.0f);
    in.footprint_alpha2 = s.footprint_alpha2;
    in.lobes = kDiffuseLobe;
    return in;
  }

  // The texel of the coverage.
  FACET_INLINE T Coverage(TextureReader<T>& textures) const {
    const BoundTexture& texture = m_.Texture(m_.coverage_slot);
    switch (m_.coverage_channel) {
      case 0: return textures.template Read<kR>(texture).x;
      case 1: return textures.template Read<kG>(texture).y;
      case 2: return textures.template Read<kB>(texture).z;
      default: return textures.template Read<kA>(texture).w;
    }
  }

  // `kIsGltf`: the coverage is the base colour's alpha for certain.
  template <bool kIsGltf = false>
  FACET_INLINE Vec4<T> BaseColor(const Surface<T>& s, TextureReader<T>& textures) const {
    const bool has_coverage_apart = !kIsGltf && m_.coverage_slot != Slot::BaseColor;
    Vec4<T> c{T(m_.factors.base_color[0]) * s.color.x, T(m_.factors.base_color[1]) * s.color.y,
              T(m_.factors.base_color[2]) * s.color.z, T(m_.factors.base_color[3]) * s.color.w};
    if (has_coverage_apart && m_.ReadsCoverage()) c.w = c.w * Coverage(textures);
    if (!m_.Reads(Slot::BaseColor)) return c;
    Vec4<T> texel = textures.template Read<kRgba>(m_.Texture(Slot::BaseColor));
    if (has_coverage_apart || m_.alpha_mode == AlphaMode::Opaque) texel.w = T(1.0f);
    return c * texel;
  }

  const FrameMaterial& m_;
  TextureReader<T>* ahead_;
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
