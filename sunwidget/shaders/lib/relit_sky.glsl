// How a pixel's sky and clouds change with the sun (method "ratio").

#include "lib/terms.glsl"
#include "lib/described_sky.glsl"
#include "lib/response.glsl"

uniform float sky_strength;
uniform float cloud_strength;
uniform float silver_lining;

// Henyey–Greenstein lobe over its isotropic value, g = 0.8.
float GetForwardLobe(float cosine) {
  const float g = 0.8;
  float base = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (base * sqrt(base));
}

// Light of a cloud of this opacity: what falls on it, and what comes through it from the sky
// behind and around, the more the thinner it is.
vec3 GetCloud(vec3 lit, vec3 forward, vec3 sky_beyond, vec3 sun, vec3 view, float opacity) {
  float lobe = 0.25 * silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  return mix(lit + lobe * forward, sky_beyond, 0.7 * (1.0 - opacity) + 0.15);
}

// `light` of the photo's sky becomes the light under the new sun. `clean` is the sky without the
// old sun (sky_behind.glsl), `mark` where the old sun's glare lies, `disc` the new disc.
vec3 GetSkyChange(vec3 light, vec3 clean, float opacity, float mark, vec3 sky_before, vec3 sky_now,
                  vec3 view, vec3 disc) {
  float gain = term[0].x;
  float moved = term[0].y;
  float glare = mark * moved * step(1e-6, sky_strength);
  vec3 sky = light + glare * (clean - light);
  vec3 cloud_before = GetCloud(term[5].rgb, term[6].rgb, sky_before, term[9].rgb, view, opacity);
  vec3 cloud_now = GetCloud(term[7].rgb, term[8].rgb, sky_now, GetDescribedSun(), view, opacity);
  vec3 plain = GetRatio(sky_now, sky_before);
  vec3 veiled = GetRatio(mix(sky_now, cloud_now, opacity), mix(sky_before, cloud_before, opacity));
  vec3 ratio = plain + cloud_strength * (veiled - plain);
  // Beyond 8x (or an eighth) noise and clipping would be amplified: trust the model there.
  float extreme = smoothstep(2.5, 4.0, abs(log2(GetLuminance(ratio) * gain)));
  vec3 relit = sky * ratio;
  relit += extreme * moved * (clean * ratio - relit);
  // A camera's colours pale in bright light: where the new sun's glow is many times what was there,
  // a sky that was purer than the model's would make it cyan.
  float glow = smoothstep(2.0, 3.5, log2(GetLuminance(sky_now) / GetLuminance(sky_before)));
  vec3 pale = sky_now * (GetLuminance(relit) / GetLuminance(sky_now));
  relit += glow * (1.0 - opacity) * (pale - relit);
  // The new disc, behind clouds; the matte hides it behind land.
  relit += moved * (1.0 - opacity) * (1.0 - opacity) * disc;
  return sky_strength * (gain * relit - light);
}
