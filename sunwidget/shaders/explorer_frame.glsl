// SkyExplorer's picture: the sky by the chosen model, by another one to the right of the middle
// where two are compared, the sun's disc with its glow, and the way to display light.
// With `output_transfer` 0 it is the sky's spectral radiance itself, without sun or exposure.

#include "lib/shown.glsl"
#include "lib/srgb.glsl"
#include "lib/pixel.glsl"

uniform sampler2D rays;
uniform sampler2D reference;
uniform sampler2D sun_disc;
uniform sampler2D adaptation;
uniform float model;
uniform float compare;        // 0 none, else 1 + a model
uniform float show_multiple;

// The eye's own glare round the sun, far weaker than an eye's: enough to see the sun where its disc
// is a pixel. A Moffat profile per unit of illuminance, 1/sr.
const float GLOW = 0.35;
const float GLOW_FALL = 1.35;

// The shoulder: light above WHITE_START of the display's loses its colour by and by, up to
// WHITE_SHARE of it at WHITE_END, so that the disc of a low sun is still warm.
const float CONTRAST = 1.12;
const float WHITE_START = 1.6;
const float WHITE_END = 200.0;
const float WHITE_SHARE = 0.86;

// The picture of the disc (sun_disc.glsl) where it lies, in the plane that touches the sphere of
// directions at the sun. `scale` is one over half its side.
vec3 GetDisc(vec3 view, vec3 sun, float scale) {
  vec3 right = vec3(sun.z, 0.0, -sun.x) * inversesqrt(max(dot(sun.xz, sun.xz), 1e-20));
  float ahead = dot(view, sun);
  vec2 offset = vec2(dot(view, right), dot(view, cross(sun, right))) * (scale / max(ahead, 1e-3));
  float within = step(0.0, ahead) * step(max(abs(offset.x), abs(offset.y)), 1.0);
  // The nearest texel: there are as many as a zoomed camera has pixels for a disc.
  vec2 size = vec2(textureSize(sun_disc, 0));
  ivec2 texel = ivec2(clamp((0.5 + 0.5 * offset) * size, vec2(0.0), size - 1.0));
  return within * texelFetch(sun_disc, texel, 0).rgb;
}

// Colours outside Rec. 709 lose as much of their colour as takes them to its edge.
vec3 FitGamut(vec3 light) {
  float luminance = max(GetLuminance(light), 0.0);
  float lowest = min(light.r, min(light.g, light.b));
  float kept = lowest < 0.0 ? luminance / max(luminance - lowest, 1e-12) : 1.0;
  return max(mix(vec3(luminance), light, kept), 0.0);
}

// Display light in [0, 1]. The largest channel alone runs through the shoulder, and the others
// keep their share of it: a low sun stays orange instead of turning yellow.
vec3 GetDisplayLight(vec3 scene) {
  vec3 light = FitGamut(scene);
  float peak = max(light.r, max(light.g, light.b));
  if (peak <= 0.0) return vec3(0.0);
  float shown = 1.0 - exp(-pow(peak, CONTRAST));
  float white = WHITE_SHARE * smoothstep(log(WHITE_START), log(WHITE_END), log(peak));
  return shown * mix(light / peak, vec3(1.0), white);
}

void main() {
  vec2 pixel = GetPixel();
  ivec2 texel = ivec2(pixel - tile_origin);
  vec4 ray = texelFetch(rays, texel, 0);
  float from_middle = pixel.x - 0.5 * frame_size.x;
  bool right = compare > 0.5 && from_middle > 0.0;
  SkyView sky = ReadSkyView(shown);
  vec4 radiance = GetShownRadiance(sky, right ? 1 : 0, ray.xyz);
  // Where no reference is drawn another table is bound, of another size.
  vec4 traced = texelFetch(reference, min(texel, textureSize(reference, 0) - 1), 0);
  bool is_traced = int((right ? compare - 1.0 : model) + 0.5) == MODEL_REFERENCE;
  radiance = max(radiance + (is_traced ? show_multiple * traced : vec4(0.0)), 0.0);
  vec4 adapted = texelFetch(adaptation, ivec2(0), 0);
  vec4 scales = texelFetch(adaptation, ivec2(1, 0), 0);
  vec3 away = ray.xyz - sky.sun;
  float glow = GLOW * pow(1.0 + dot(away, away) * scales.g, -GLOW_FALL);
  vec3 light = SpectralToRec709(radiance) + GetDisc(ray.xyz, sky.sun, scales.r) + glow * adapted.rgb;
  vec3 display = GetDisplayLight(adapted.a * light);
  float divide = compare > 0.5 ? 0.6 * clamp(1.0 - abs(from_middle), 0.0, 1.0) : 0.0;
  vec3 code = EncodeSrgb(mix(display, vec3(1.0), divide)) + GetDither(pixel);
  // Premultiplied, as canvases want it.
  result = output_transfer == 0 ? radiance : vec4(ray.a * clamp(code, 0.0, 1.0), ray.a);
}
