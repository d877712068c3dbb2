// The light of the photo's clouds under a sun, for relighting in the frame and for comparing photo and model.

#include "sky/sun_visible.glsl"
#include "frame/srgb.glsl"
#include "clouds/forward_lobe.glsl"

uniform float silver_lining;

// Heights of the sun (sines) at which clouds at two kilometers have lost it and still have it; high thin ones keep it.
const float kLowCloudsUnlit = -0.045;
const float kLowCloudsLit = -0.004;
// Sines of a visible sun's height: below the first, sky and clouds have the same color.
const vec2 kCloudsSeparable = vec2(0.1, 0.25);
// Share of the sun's light that remains, scattered, on low clouds that have lost the sun.
const float kAfterglow = 0.4;
const float kMostBehind = 3.0;  // luminance relative to the clouds' skylight

// The trusted part of a cloud's opacity in relighting. Around a low sun colors do not separate cloud from clear air,
// and the whole sky changes as its air does.
float GetKnownOpacity(float opacity, vec3 sun_before) {
  float sun_seen = sun_visible * (1.0 - photo_light);
  return opacity * (1.0 - sun_seen * (1.0 - smoothstep(kCloudsSeparable.x, kCloudsSeparable.y, sun_before.y)));
}

// A cloud's share of full sunlight, from its brightness in the photo: its light is the
// sky's minus the light from beyond it. Light inside a cloud is scattered sunlight, too, and the
// brightness in one map is no measurement, so the share stays near its mean. `sky` has no detail,
// because otherwise a cloud's bright parts would lose more than its dark ones and leave a flat gray.
float GetSunlitShare(vec3 sky, vec3 sky_before, vec3 ambient, vec3 direct, float opacity) {
  float cloud = GetLuminance(sky - (1.0 - opacity) * sky_before) / max(opacity, 0.5);
  float share = (cloud - GetLuminance(ambient)) / max(GetLuminance(direct), 1e-9);
  float known = smoothstep(0.3, 0.9, opacity) * smoothstep(0.1, 0.5, GetLuminance(direct) / GetLuminance(ambient));
  return mix(1.0, 0.6 + 0.4 * clamp(share, 0.0, 1.0), known);
}

// The sky's light by the model without the peak around a sun that clouds hide, by the share `hidden`.
vec3 GetSkyBehindClouds(vec3 sky, vec3 ambient, float hidden) {
  float most = kMostBehind * GetLuminance(ambient) / max(GetLuminance(sky), 1e-9);
  return sky * mix(1.0, min(most, 1.0), hidden);
}

// Light of a cloud of this opacity: the sky's and its share of the sun's, the forward scattering of a thin
// cloud (a silver lining), and the light from the sky beyond that passes through.
vec3 GetCloud(vec3 ambient, vec3 direct, float share, vec3 sky_beyond, vec3 sun, vec3 view, float opacity) {
  float low = mix(kAfterglow, 1.0, smoothstep(kLowCloudsUnlit, kLowCloudsLit, sun.y));
  float lit = share * mix(1.0, low, opacity * opacity);
  float lobe = 0.25 * silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  return mix(ambient + (lit + lobe) * direct, sky_beyond, 0.7 * (1.0 - opacity) + 0.15);
}
