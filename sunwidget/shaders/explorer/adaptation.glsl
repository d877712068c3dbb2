// Values shared by all pixels of the picture, two texels:
//   0  r, g, b the sun's illuminance at normal incidence (linear Rec. 709, klx), pale like its glow,
//      0 where no disc is drawn; a the gain from luminance (kcd m^-2) to display light
//   1  r one over the reach of the disc's picture, g one over the square of the glow's radius
//
// The eye adapts to the sky above and to a meadow below, each half of the view. So a high
// camera, in full sun under a black sky, is exposed for the sun.

#include "explorer/projection.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "explorer/read_sun_disc.glsl"
#include "frame/srgb.glsl"

uniform sampler2D light;
uniform float exposure;       // stops
uniform float auto_exposure;  // 0 keeps the exposure of noon, 1 adapts fully
out vec4 result;

const float kMeadowAlbedo = 0.06;
const float kNoon = 2.85;    // kcd m^-2: GetMeanLuminance with the sun at 60 degrees in the default atmosphere
const float kKey = 0.14;     // display light of the mean
const float kNight = 1e-9;    // least mean luminance
const Angle kGlowRadius = 0.011;
const float kGlowColor = 0.6;  // share of the sun's color in its glow

vec3 GetIlluminance(int texel) {
  return SpectralToRec709(texelFetch(light, ivec2(texel, 0), 0));
}

float GetMeanLuminance(float sky, float sun) {
  return 0.5 / kPi * (sky + kMeadowAlbedo * (sky + sun));
}

void main() {
  if (gl_FragCoord.x > 1.0) {
    float radius = kGlowRadius * max(sun_size, 0.5);
    result = vec4(1.0 / GetDiscReach(), 1.0 / (radius * radius), 0.0, 0.0);
    return;
  }
  vec3 sun = GetIlluminance(1);
  // Texel 0 is the sky's light on level ground; the sun's light there scales with the sine of its elevation.
  float height = max(sin(radians(sun_elevation)), 0.0);
  float mean = max(GetMeanLuminance(GetLuminance(GetIlluminance(0)), GetLuminance(sun) * height), kNight);
  float gain = kKey * exp2(exposure) * pow(mean, -auto_exposure) * pow(kNoon, auto_exposure - 1.0);
  vec3 glow = mix(vec3(GetLuminance(sun)), sun, kGlowColor);
  result = vec4(min(sun_size, 1.0) * max(glow, 0.0), gain);
}
