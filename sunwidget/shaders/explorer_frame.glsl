// SkyExplorer's picture: the sky by the chosen model, by another one to the right of the middle
// where two are compared, the sun's disc with its glow, and the way to display light.
// With `output_transfer` 0 it is the sky's spectral radiance itself, without sun or exposure.

#include "lib/shown.glsl"
#include "lib/srgb.glsl"
#include "lib/pixel.glsl"

uniform sampler2D rays;
uniform sampler2D reference;
uniform sampler2D sun_disc;
uniform float model;
uniform float compare;        // 0 none, else 1 + a model
uniform float show_multiple;

flat in vec4 described[4];  // explorer_constants.glsl
flat in vec4 adapted;
flat in vec4 scales;

// Glare round the sun, far weaker than in an eye: enough to see the sun where its disc
// is a pixel. A Moffat profile per unit of illuminance, 1/sr.
const float GLOW = 0.5;
const float GLOW_FALL = 1.35;

// Skies lie close to grey; a picture of them without the dazzle of the real one needs more colour,
// the more the less there is, and less in green, or blues would turn violet and oranges red.
const vec3 SATURATION = vec3(0.7, 0.25, 0.7);
// Colours keep their distance from white up to this; what lies beyond, also outside Rec. 709, is
// drawn in.
const float PURITY = 0.85;
const float CONTRAST = 1.3;
const float RESTRAINT = 0.4;  // of what is bright, so that the sun stands out from its aureole
const float WHITE = 60.0;   // light that is drawn as white
const vec3 BLEACH = vec3(0.9, 0.9, 0.75);  // share of its colour that far brighter light loses

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

// Display light in [0, 1]. The largest channel alone runs through the shoulder (Reinhard et al. 2002,
// eq. 4), and the others keep their share of it: a low sun stays orange instead of turning yellow.
vec3 GetDisplayLight(vec3 light) {
  float peak = max(light.r, max(light.g, max(light.b, 1e-9)));
  vec3 away = 1.0 - light / peak;
  away *= 1.0 + SATURATION * (1.0 - away);
  vec3 beyond = max(away - PURITY, 0.0) / (1.0 - PURITY);
  away = min(away, PURITY) + (1.0 - PURITY) * beyond / (1.0 + beyond);
  float x = pow(peak, CONTRAST) * inversesqrt(1.0 + RESTRAINT * peak);
  float shown = min(x * (1.0 + x / (WHITE * WHITE)) / (1.0 + x), 1.0);
  return shown * (1.0 - away * (1.0 - BLEACH * x / (x + WHITE)));
}

void main() {
  vec2 pixel = GetPixel();
  ivec2 texel = ivec2(pixel - tile_origin);
  vec4 ray = texelFetch(rays, texel, 0);
  float from_middle = pixel.x - 0.5 * frame_size.x;
  bool right = compare > 0.5 && from_middle > 0.0;
  SkyView sky = SkyView(described[0].xyz, described[0].w, described[1], described[2], described[3].x);
  vec4 radiance = GetShownRadiance(sky, right ? 1 : 0, ray.xyz);
  // Where no reference is drawn another table is bound, of another size.
  vec4 traced = texelFetch(reference, min(texel, textureSize(reference, 0) - 1), 0);
  bool is_traced = int((right ? compare - 1.0 : model) + 0.5) == MODEL_REFERENCE;
  radiance = max(radiance + (is_traced ? show_multiple * traced : vec4(0.0)), 0.0);
  vec3 away = ray.xyz - sky.sun;
  float glow = GLOW * pow(1.0 + dot(away, away) * scales.g, -GLOW_FALL);
  vec3 light = SpectralToRec709(radiance) + GetDisc(ray.xyz, sky.sun, scales.r) + glow * adapted.rgb;
  vec3 display = GetDisplayLight(adapted.a * light);
  float divide = compare > 0.5 ? 0.6 * clamp(1.0 - abs(from_middle), 0.0, 1.0) : 0.0;
  vec3 code = EncodeSrgb(mix(display, vec3(1.0), divide)) + GetDither(pixel);
  // Premultiplied, as canvases want it.
  result = output_transfer == 0 ? radiance : vec4(ray.a * clamp(code, 0.0, 1.0), ray.a);
}
