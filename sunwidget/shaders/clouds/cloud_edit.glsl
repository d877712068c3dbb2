// The user's cloud edits applied to the light of a pixel's sky: clear sky S behind cloud of opacity a
// and light C is I = (1 - a) S + a C. With another opacity e it is I + (e / a - 1) (I - S), for any
// C: thinned clouds blend with the clear sky behind them, and thickened ones move away from it.

#include "clouds/cloud_opacity.glsl"
#include "frame/srgb.glsl"

uniform float added_clouds;

// Slowly varying fields are stored as logarithms of light over matched model (analysis/clear_sky.py).
vec3 DecodeResidual(vec3 code) {
  return exp(4.0 * code - 2.0);
}

bool IsCloudEdited() {
  return cloud_opacity != 1.0 || cloud_softness != 0.0 || added_clouds > 0.0;
}

// Opacity below which a pixel is left unchanged, and above which it counts entirely as cloud.
const float kNoCloud = 0.01;
const float kCloud = 0.12;

// A thickened cloud moves away from its clear sky more in luminance than in color, and within limits: where
// sky and cloud have the same color the sky behind is a guess.
vec3 GetThickened(vec3 light, vec3 wanted) {
  vec3 ratio = clamp(wanted / max(light, vec3(1e-6)), vec3(0.5), vec3(1.6));
  float level = clamp(GetLuminance(wanted) / max(GetLuminance(light), 1e-6), 0.5, 1.6);
  return light * mix(ratio, vec3(level), 0.6);
}

// Edits the `light` of the sky. `clear` is the sky behind its clouds, `dissolved` the light with dissolved
// edges, `layer.r` the matte, `layer.g` and `soft` as in EditOpacity, `added` the added layer's light times its
// opacity, and this opacity. Where `confidence` is 0 (the old sun's glare) a pixel does not reveal clouds.
vec3 GetEditedSky(vec3 light, vec3 clear, vec3 dissolved, vec4 layer, float soft, float confidence, vec4 added) {
  float own = min(layer.g / max(layer.r, 1.0 / 255.0), 1.0);
  float softened = confidence * GetSofteningShare(soft);
  vec3 edited = light + softened * (dissolved - light);
  float opacity = mix(own, soft, softened);
  float scale = GetScaledOpacity(opacity) / max(opacity, 1e-3) - 1.0;
  // Gaps between clouds hold thin cloud that un-mixing misses: thinning removes it, too.
  float thinned = smoothstep(kNoCloud, kCloud, max(opacity, 0.4 * soft)) * confidence;
  float thickened = smoothstep(kNoCloud, kCloud, opacity) * confidence;
  vec3 thin = edited + thinned * min(cloud_opacity - 1.0, 0.0) * (edited - clear);
  vec3 thick = GetThickened(edited, edited + thickened * scale * (edited - clear));
  edited = cloud_opacity > 1.0 ? thick : thin;
  return edited * (1.0 - added.a) + added.rgb;
}
