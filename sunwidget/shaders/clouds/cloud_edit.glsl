// What a person's changes do to the light of a pixel's sky: clear sky S seen past cloud of opacity a
// and light C is I = (1 - a) S + a C. With another opacity e it is I + (e / a - 1) (I - S), whatever C
// is: thinned clouds are a blend with the clear sky behind them, and thickened ones part from it.

#include "clouds/cloud_opacity.glsl"
#include "frame/srgb.glsl"

uniform float added_clouds;

// Slow fields are kept as logarithms of light over matched model (analysis/clear_sky.py).
vec3 DecodeResidual(vec3 code) {
  return exp(4.0 * code - 2.0);
}

bool IsCloudEdited() {
  return cloud_opacity != 1.0 || cloud_softness != 0.0 || added_clouds > 0.0;
}

// Opacity below which a pixel is left alone, and above which it is all taken for cloud.
const float kNoCloud = 0.01;
const float kCloud = 0.12;

// Thickened, a cloud parts from its clear sky in light more than in color, and within limits: where
// sky and cloud are of one color the sky behind is a guess.
vec3 GetThickened(vec3 light, vec3 wanted) {
  vec3 ratio = clamp(wanted / max(light, vec3(1e-6)), vec3(0.5), vec3(1.6));
  float level = clamp(GetLuminance(wanted) / max(GetLuminance(light), 1e-6), 0.5, 1.6);
  return light * mix(ratio, vec3(level), 0.6);
}

// `light` of the sky, `clear` what is behind its clouds, `dissolved` the light where its edges are
// gone, `layer` and `soft` as in EditOpacity, `added` the added layer's light times its opacity, and
// this. Where `sure` is 0 (the old sun's glare) a pixel tells nothing of clouds.
vec3 GetEditedSky(vec3 light, vec3 clear, vec3 dissolved, vec4 layer, float soft, float sure, vec4 added) {
  float own = min(layer.g / max(layer.r, 1.0 / 255.0), 1.0);
  float softened = sure * GetSoftened(soft);
  vec3 edited = light + softened * (dissolved - light);
  float opacity = mix(own, soft, softened);
  float scale = GetThinned(opacity) / max(opacity, 1e-3) - 1.0;
  // Gaps between clouds hold thin cloud that un-mixing misses: thinning takes it along.
  float thinned = smoothstep(kNoCloud, kCloud, max(opacity, 0.4 * soft)) * sure;
  float thickened = smoothstep(kNoCloud, kCloud, opacity) * sure;
  vec3 thin = edited + thinned * min(cloud_opacity - 1.0, 0.0) * (edited - clear);
  vec3 thick = GetThickened(edited, edited + thickened * scale * (edited - clear));
  edited = cloud_opacity > 1.0 ? thick : thin;
  return edited * (1.0 - added.a) + added.rgb;
}
