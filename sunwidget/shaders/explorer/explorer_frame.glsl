// SkyExplorer's picture: the sky by the chosen model (right of the middle by a second one, if two are
// compared), the sun's disc with its glow, and the conversion to display light.
// With `output_transfer` 0 it is the sky's spectral radiance itself, without sun or exposure.

#include "explorer/read_shown.glsl"
#include "frame/srgb.glsl"
#include "frame/pixel.glsl"

uniform sampler2D rays;
uniform sampler2D reference;
uniform sampler2D sun_disc;
uniform float model;
uniform float compare;        // 0 none, else 1 + a model
uniform float show_multiple;

flat in vec4 described[4];  // explorer_constants.glsl
flat in vec4 adapted;
flat in vec4 scales;

// Glare around the sun, far weaker than in an eye: enough to see a sun whose disc is only
// a pixel. A Moffat profile per unit of illuminance, 1/sr.
const float kGlow = 0.8;
const float kGlowFall = 1.35;

// The display response works like film, channel by channel, so that a low sun's light goes from red
// through orange and yellow to white. Before it the channels are mixed a little towards gray, which
// brings colors outside Rec. 709 into gamut and lets the brightest lose their color; after it they
// are separated by more than that, because a picture without the dazzle of a real sky needs more
// color.
const float kInset = 0.06;
const float kOutset = 0.3;
const float kContrast = 1.25;
const float kGray = 0.18;  // is mapped to itself

// The picture of the disc (sun_disc.glsl), which lies in the plane tangent to the sphere of
// directions at the sun. `scale` is one over half its side.
vec3 GetDisc(vec3 view, vec3 sun, float scale) {
  vec3 right = vec3(sun.z, 0.0, -sun.x) * inversesqrt(max(dot(sun.xz, sun.xz), 1e-20));
  float ahead = dot(view, sun);
  vec2 offset = vec2(dot(view, right), dot(view, cross(sun, right))) * (scale / max(ahead, 1e-3));
  float within = step(0.0, ahead) * step(max(abs(offset.x), abs(offset.y)), 1.0);
  // The nearest texel suffices: there are as many texels as a zoomed camera has pixels for the disc.
  vec2 size = vec2(textureSize(sun_disc, 0));
  ivec2 texel = ivec2(clamp((0.5 + 0.5 * offset) * size, vec2(0.0), size - 1.0));
  return within * texelFetch(sun_disc, texel, 0).rgb;
}

// Display light in [0, 1]: a response x^n / (x^n + k^n) like that of eyes and film (Naka & Rushton 1966).
vec3 GetDisplayLight(vec3 light) {
  vec3 inset = max(mix(light, vec3(dot(light, vec3(1.0 / 3.0))), kInset), 0.0);
  vec3 power = pow(inset, vec3(kContrast));
  vec3 shown = power / (power + pow(kGray, kContrast - 1.0) * (1.0 - kGray));
  float gray = dot(shown, vec3(1.0 / 3.0));
  return gray + (shown - gray) / (1.0 - kOutset);
}

void main() {
  vec2 pixel = GetPixel();
  ivec2 texel = ivec2(pixel - tile_origin);
  vec4 ray = texelFetch(rays, texel, 0);
  float from_middle = pixel.x - 0.5 * frame_size.x;
  bool right = compare > 0.5 && from_middle > 0.0;
  SkyView sky = SkyView(described[0].xyz, described[0].w, described[1], described[2], described[3].x);
  vec4 radiance = GetShownRadiance(sky, right ? 1 : 0, ray.xyz);
  // If no reference is drawn, another table of another size is bound.
  vec4 traced = texelFetch(reference, min(texel, textureSize(reference, 0) - 1), 0);
  bool is_traced = int((right ? compare - 1.0 : model) + 0.5) == kModelReference;
  radiance = max(radiance + (is_traced ? show_multiple * traced : vec4(0.0)), 0.0);
  vec3 away = ray.xyz - sky.sun;
  float glow = kGlow * pow(1.0 + dot(away, away) * scales.g, -kGlowFall);
  vec3 light = SpectralToRec709(radiance) + GetDisc(ray.xyz, sky.sun, scales.r) + glow * adapted.rgb;
  vec3 display = GetDisplayLight(adapted.a * light);
  float divide = compare > 0.5 ? 0.6 * clamp(1.0 - abs(from_middle), 0.0, 1.0) : 0.0;
  vec3 code = EncodeSrgb(mix(display, vec3(1.0), divide)) + GetDither(pixel);
  // Premultiplied, as canvases require.
  result = output_transfer == 0 ? radiance : vec4(ray.a * clamp(code, 0.0, 1.0), ray.a);
}
