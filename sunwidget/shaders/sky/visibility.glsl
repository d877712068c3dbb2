// The visible share of the sun's disc in the picture: one pixel, r in [0, 1]; g the same for the
// bright sky around it, kAureole wide, for the glow, which appears before the disc and outlasts it, and shines
// through clouds.
// Land hides the sun (sky matte), clouds veil it (opacity); light.glsl handles the horizon itself,
// so only the part of the disc above it is counted here. A sun that the photo shows (its glare, in
// `surface`) is not behind the thick cloud that its whiteness suggests. Outside the picture the
// edge's value fades to "visible" over a tenth of the picture. `sun_visibility` veils all of it. b is g in the picture,
// and fades to 0 within half of it outside.

#include "frame/picture.glsl"
#include "frame/rolled.glsl"
#include "clouds/cloud_cover.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "camera/response.glsl"

uniform sampler2D layers;
uniform sampler2D surface;
uniform sampler2D backdrop;
uniform vec3 photo_sky_linear_mean;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_visibility;

out vec4 result;

const float kDiscRadius = 0.2665;  // degrees
const int kRings = 3;
const int kSpokes = 12;

// Added clouds are bright themselves and transmit light: they remove at most this share
// (a cloud of optical depth 16 transmits a third), and cover the sun gradually.
const float kCloudShade = 0.65;
const float kCloudPenumbra = 10.0;  // in disc radii
const float kAureole = 4.0;         // in disc radii
// The share of the glow that bright clouds take. Many times less light passes them, but a camera exposes for it.
const float kGlowTaken = 0.65;
// Luminance of clouds, relative to the sky's mean, that take all of it, and of those that do not.
const vec2 kBrightCloud = vec2(0.6, 1.2);

// Distance outside the picture, in widths and heights; negative inside.
float GetOutside(vec3 at) {
  vec2 past = max(-at.xy, at.xy - 1.0);
  return at.z > 0.0 ? max(past.x, past.y) : 1.0;
}

// The visible share in one direction, and that of the glow.
vec2 GetOpening(vec3 direction) {
  vec3 at = GetPlaceOfDirection(direction);
  vec4 layer = ReadBilinear(layers, at.xy);
  float cloud = GetOwnOpacity(layers, at.xy) * (1.0 - 0.8 * ReadBilinear(surface, at.xy).r);
  float light = GetLuminance(GetBackdropLight(ReadBilinear(backdrop, at.xy).rgb))
      / max(GetLuminance(GetSceneLight(photo_sky_linear_mean)), 1e-4);
  float taken = mix(1.0, kGlowTaken, smoothstep(kBrightCloud.x, kBrightCloud.y, light));
  vec2 open = layer.r * (1.0 - vec2(1.0, taken) * cloud);
  return mix(open, vec2(1.0), smoothstep(0.0, 0.1, GetOutside(at)));
}

void main() {
  vec2 open = vec2(0.0);
  vec2 above = vec2(0.0);
  float shaded = 0.0;
  int samples = GetSteps(kRings * kSpokes, frame_size);
  for (int i = 0; i < samples; ++i) {
    float ring = float(i / kSpokes);
    // Rings of equal area.
    float radius = kDiscRadius * sqrt((ring + 0.5) / float(kRings));
    float turn = 6.28318531 * (float(i % kSpokes) + 0.5 * ring) / float(kSpokes);
    vec2 aside = radius * vec2(cos(turn), sin(turn));
    for (int part = 0; part < GetSteps(2, frame_size); ++part) {
      vec2 at = vec2(sun_azimuth, sun_elevation) + (part == 0 ? 1.0 : kAureole) * aside;
      float weight = smoothstep(-0.05, 0.05, at.y) + 1e-4;
      open[part] += weight * GetOpening(GetSunDirection(at.x, at.y))[part];
      above[part] += weight;
    }
    vec2 wide = kCloudPenumbra * aside;
    shaded += GetAddedCover(GetSunDirection(sun_azimuth + wide.x, sun_elevation + wide.y));
  }
  float added = 1.0 - kCloudShade * shaded / float(kRings * kSpokes);
  vec2 visible = sun_visibility * added * open / above;
  vec3 at = GetPlaceOfDirection(GetSunDirection(sun_azimuth, sun_elevation));
  result = vec4(visible, visible.g * smoothstep(-0.5, 0.1, -GetOutside(at)), 1.0);
}
