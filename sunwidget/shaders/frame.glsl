// The picture, method "ratio": every term is a ratio new/old of one model at two suns, so an
// unmoved sun multiplies by exactly one. Where a ratio means nothing (clipped pixels, the old
// disc and its halo, extreme ratios) the frame cross-fades to the matched model itself.

#include "lib/picture.glsl"
#include "lib/response.glsl"
#include "lib/output.glsl"

uniform sampler2D photo;
uniform sampler2D scene_light;
uniform sampler2D layers;
uniform sampler2D surface;
uniform sampler2D sky_source;
uniform sampler2D sky_edit;
uniform sampler2D sky_behind;
uniform sampler2D mirror_ratio;
uniform sampler2D disc;
uniform sampler2D terms;

uniform float sky_strength;
uniform float cloud_strength;
uniform float silver_lining;
uniform float land_strength;

vec3 GetTerm(int index) {
  return texelFetch(terms, ivec2(index, 0), 0).rgb;
}

// Henyey–Greenstein lobe over its isotropic value, g = 0.8.
float GetForwardLobe(float cosine) {
  const float g = 0.8;
  float base = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (base * sqrt(base));
}

// The new disc where its picture lies (disc.glsl), nothing elsewhere.
vec3 ReadDisc(vec3 view, vec3 sun) {
  float ahead = dot(view, sun);
  vec2 place = 0.5 + 0.5 * vec2(dot(view, GetTerm(11)), dot(view, GetTerm(12))) / max(ahead, 1e-3);
  vec2 within = step(vec2(0.0), place) * step(place, vec2(1.0));
  return step(0.0, ahead) * within.x * within.y * ReadBilinear(disc, place).rgb;
}

// Light of a cloud of this opacity: what falls on it, and what comes through it from the sky
// behind and around, the more the thinner it is.
vec3 GetCloud(vec3 lit, vec3 forward, vec3 sky_beyond, vec3 sun, vec3 view, float opacity) {
  float lobe = 0.25 * silver_lining * GetForwardLobe(dot(sun, view)) * (1.0 - opacity);
  return mix(lit + lobe * forward, sky_beyond, 0.7 * (1.0 - opacity) + 0.15);
}

// Share of a pixel's light that is sky. Where the matte is soft a pixel shows both, and twigs
// before a bright sky are mostly sky: the light behind is known (sky_behind.glsl), and the rest is
// the land's own, without the old sky's tint. Inside the sky it is the matte itself, and so it is
// where the matte promises more sky than the pixel holds (it is wrong there) and in the glare.
vec3 GetSkyShare(float matte, vec3 scene, vec3 behind, float glare) {
  vec3 light = matte * behind;
  float excess = GetLuminance(light) / max(GetLuminance(scene), 1e-6);
  float plain = max(smoothstep(0.85, 1.0, matte), smoothstep(0.9, 1.6, excess));
  return mix(min(light / max(scene, vec3(1e-6)), vec3(1.0)), vec3(matte), max(plain, glare));
}

void main() {
  vec2 pixel = GetPixel();
  vec2 place = pixel / frame_size;
  ivec2 texel = ivec2(pixel - tile_origin);
  vec3 view = GetViewDirection(place);
  vec3 display = ReadPicture(photo, place).rgb;
  vec3 scene = texelFetch(scene_light, texel, 0).rgb;
  vec4 layer = ReadPicture(layers, place);
  vec4 marks = ReadPicture(surface, place);
  vec3 sky_before = texelFetch(sky_source, texel, 0).rgb;
  vec3 sky_now = texelFetch(sky_edit, texel, 0).rgb;
  vec3 sun_before = GetTerm(9);
  vec3 sun_now = GetTerm(10);
  vec3 general = GetTerm(0);
  float gain = general.x;
  float moved = general.y;

  // What of the pixel is sky and what is land, each as if it filled the pixel.
  vec3 clean = texelFetch(sky_behind, texel, 0).rgb;
  float matte = layer.r;
  vec3 share = GetSkyShare(matte, scene, clean, marks.r);
  vec3 behind = scene * share / max(matte, 1e-4);
  vec3 front = scene * (1.0 - share) / max(1.0 - matte, 1e-4);

  // Sky and clouds.
  float glare = marks.r * moved * step(1e-6, sky_strength);
  vec3 sky = behind + glare * (clean - behind);
  float opacity = min(layer.g / max(matte, 1.0 / 255.0), 1.0);  // of the sky's share
  vec3 cloud_before = GetCloud(GetTerm(5), GetTerm(6), sky_before, sun_before, view, opacity);
  vec3 cloud_now = GetCloud(GetTerm(7), GetTerm(8), sky_now, sun_now, view, opacity);
  vec3 plain = GetRatio(sky_now, sky_before);
  vec3 veiled = GetRatio(mix(sky_now, cloud_now, opacity), mix(sky_before, cloud_before, opacity));
  vec3 ratio = plain + cloud_strength * (veiled - plain);
  // Beyond 8x (or an eighth) noise and clipping would be amplified: trust the model there.
  float extreme = smoothstep(2.5, 4.0, abs(log2(GetLuminance(ratio) * gain)));
  vec3 relit = sky * ratio;
  relit += extreme * moved * (clean * ratio - relit);
  // The new disc, behind clouds; the matte hides it behind land.
  float clear = (1.0 - opacity) * (1.0 - opacity);
  relit += moved * clear * ReadDisc(view, sun_now);
  vec3 sky_change = sky_strength * (gain * relit - behind);

  // Land: ratio of irradiances. What rises above the horizon stands upright.
  float upright = 0.8 * smoothstep(-0.005, 0.02, view.y);
  vec3 lit_before = mix(GetTerm(1), GetTerm(2), upright);
  vec3 lit_now = mix(GetTerm(3), GetTerm(4), upright);
  vec3 land_ratio = GetRatio(lit_now, lit_before);
  // What exceeds white paint in this light is a mirror image of the sky and the sun (water, wet
  // road, glass): that part follows what it mirrors (mirror_ratio.glsl), the rest is lit as land.
  float glitter = marks.b;
  float white = (1.0 - 0.6 * glitter) * GetLuminance(lit_before) / 3.14159265;
  float mirror = max(1.0 - min(white / max(GetLuminance(front), 1e-6), 1.0), marks.g);
  land_ratio += mirror * (ReadBilinear(mirror_ratio, place).rgb - land_ratio);
  vec3 land = front * land_ratio;
  land += general.z * (vec3(GetLuminance(land)) - land);
  vec3 land_change = land_strength * (gain * land - front);

  // Written as a difference, so that what did not change adds exactly nothing.
  vec3 change = matte * sky_change + (1.0 - matte) * land_change;
  float touched = step(1e-30, dot(abs(change), vec3(1.0)));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  WriteFrame(display, touched * (GetDisplayLight(scene + change) - representable), pixel);
}
