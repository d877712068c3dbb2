// Light of lamps behind window panes (analysis/windows/panes.py). It is added, not a ratio. By day it is present but
// drowned out; the darker the picture's own light, the more of it is visible.

#include "frame/picture.glsl"
#include "sky/matched_sky.glsl"

uniform sampler2D lamps;
uniform float window_lights;       // brightness of a median lamp, 0 = exactly off
uniform float window_temperature;  // K
uniform float lamp_scale;          // light of a texture level of 1, in median lamps

const float kPane = 0.05;      // kcd m^-2: a lit room seen through a pane
const float kSpread = 0.2;     // relative spread of the temperature to either side
const float kPaintedWhite = 0.8;
const float kSpill = 0.25;     // illuminance over pi close to a window, relative to the window's luminance

// Linear Rec. 709 of a black body, luminance 1: chromaticities by Kim et al. 2002 (US patent 7024034), 1667 to 25000 K.
vec3 GetBlackBody(float kelvin) {
  float t = 1000.0 / clamp(kelvin, 1667.0, 25000.0);
  float x = kelvin < 4000.0 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.17991
                            : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.24039;
  float y = kelvin < 2222.0 ? ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
      : kelvin < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                        : ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483;
  vec3 xyz = vec3(x / y, 1.0, (1.0 - x - y) / y);
  const mat3 kToRec709 = mat3(3.2409699, -0.9692436, 0.0556301, -1.5373832, 1.8759675, -0.2039770,
                              -0.4986108, 0.0415551, 1.0569715);
  return max(kToRec709 * xyz, vec3(0.0));
}

// Scene-linear light of the panes at a place, and of land with albedo `albedo` that they light. That land is at most
// white paint, and gray, because half of the color that a photo shows in shade is its light's.
vec3 GetLampLight(vec2 place, float albedo) {
  if (window_lights <= 0.0) return vec3(0.0);
  vec4 lamp = ReadBilinear(lamps, place);
  vec3 color = GetBlackBody(window_temperature * (1.0 + kSpread * (1.0 - 2.0 * lamp.b)));
  return window_lights * kPane * lamp_scale * GetLuminance(sky_gain) * color
      * (lamp.r + kSpill * lamp.g * min(albedo, kPaintedWhite));
}
