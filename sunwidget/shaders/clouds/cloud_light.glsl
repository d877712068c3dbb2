// The light of the photo's clouds under a sun: for what the frame relights and for what the photo is compared with.

#include "frame/srgb.glsl"
#include "clouds/forward_lobe.glsl"

uniform float silver_lining;
uniform float sun_visible;  // whether the photo shows its sun, 0 or 1

// Height of the sun (sine) under which clouds of two kilometres lose it, and high thin ones do not.
const float kSetsForLow = -0.045;
const float kStandsForLow = -0.004;
// Sines of a seen sun's height: below the first, sky and clouds are of one color.
const vec2 kTellsClouds = vec2(0.1, 0.25);
// Share of the sun's light that is left on low clouds then: it has been scattered there.
const float kAfterglow = 0.4;

// How much of a cloud's opacity is believed when it is lit. Round a low sun colors tell no cloud from clear air, and
// what changes like its air changes alike.
float GetKnownOpacity(float opacity, vec3 sun_before) {
  float sun_seen = sun_visible * (1.0 - photo_light);
  return opacity * (1.0 - sun_seen * (1.0 - smoothstep(kTellsClouds.x, kTellsClouds.y, sun_before.y)));
}

// A cloud's share of full sunlight, by how bright the photo shows it: its light is what is left of the
// sky's when what lies beyond it is taken away. Inside a cloud the light is scattered sunlight, too, and
// one map's brightness is no measurement: the share stays near its mean. `sky` is without detail,
// or a cloud's bright parts would lose more than its dark ones and leave a flat gray.
float GetSunlitShare(vec3 sky, vec3 sky_before, vec3 ambient, vec3 direct, float opacity) {
  float cloud = GetLuminance(sky - (1.0 - opacity) * sky_before) / max(opacity, 0.5);
  float share = (cloud - GetLuminance(ambient)) / max(GetLuminance(direct), 1e-9);
  float known = smoothstep(0.3, 0.9, opacity) * smoothstep(0.1, 0.5, GetLuminance(direct) / GetLuminance(ambient));
  return mix(1.0, 0.6 + 0.4 * clamp(share, 0.0, 1.0), known);
}

// Light of a cloud of this opacity: the sky's and its share of the sun's, what a thin one sends on
// towards the viewer (a silver lining), and what comes through it from the sky beyond.
vec3 GetCloud(vec3 ambient, vec3 direct, float share, vec3 sky_beyond, vec3 sun, vec3 view, float opacity) {
  float low = mix(kAfterglow, 1.0, smoothstep(kSetsForLow, kStandsForLow, sun.y));
  float lit = share * mix(1.0, low, opacity * opacity);
  float lobe = 0.25 * silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  return mix(ambient + (lit + lobe) * direct, sky_beyond, 0.7 * (1.0 - opacity) + 0.15);
}
