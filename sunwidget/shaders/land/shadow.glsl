// The share of the sun that reaches the land: r past other land, g past the clouds, both 1 if nothing blocks it; b
// the sunlight expected on a place from the whole photo (land/read_transfer.glsl), a the same for a uniform
// sky. A quarter of the size.
//
// Land: only a given depth map blocks the sun in r; b includes predicted shadows. The march goes through the log-depth
// from a point towards the sun, in steps that are uniform in the picture at first and uniform in log-depth later (after
// McGuire & Mara, "Efficient GPU Screen-Space Ray Tracing", JCGT 2014). Only ratios of depths matter, so the unknown
// scale of the depth does not. An obstacle counts more softly the farther along the ray it stands: this gives a
// penumbra, and no jump when the sun moves.
// Clouds: the point where the ray leaves through the cloud layer is looked up where the camera sees it in the sky.

#include "frame/picture.glsl"
#include "land/read_land_depth.glsl"
#include "land/read_transfer.glsl"
#include "atmosphere/read_sky_view.glsl"

uniform sampler2D openness;
uniform sampler2D veil_opacity;
uniform sampler2D land_depth;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float depth_told;  // whether a depth map was given, 0 or 1
uniform vec2 pass_size;

out vec4 result;

const int kSteps = 24;
const float kOctaves = 5.0;      // octaves of depth that a march spans, in ever longer steps
const float kClearance = 0.05;   // octaves behind land's face from which it blocks the ray
const float kThickness = 0.8;    // octaves behind its face at which land ends
const float kCloudHeight = 1500.0;

// The direction in camera coordinates: x right, y down, z forward.
vec3 GetCameraDirection(vec3 direction) {
  return direction.x * camera_right + direction.y * camera_up + direction.z * camera_forward;
}

// Whether land is near enough to read this texel or one of its neighbors.
bool IsNearLand(vec2 place) {
  vec2 margin = 2.5 / vec2(textureSize(land_depth, 0));
  float land = ReadLandDepth(land_depth, place).g;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2(i % 2, i / 2) * 2.0 - 1.0;
    land += ReadLandDepth(land_depth, place + margin * corner).g;
  }
  return land > 0.0;
}

// Share of the sun that land hides from a place at log-depth `level`; `sun` in camera coordinates.
float GetLandOcclusion(vec2 place, float level, vec3 sun) {
  float aspect = frame_size.x / frame_size.y;
  vec3 ray = vec3((place.x - 0.5) * aspect / camera_focal, (place.y - 0.5) / camera_focal, 1.0);
  float hidden = 0.0;
  bool near_land = IsNearLand(place);
  for (int i = 0; i < kSteps; ++i) {
    float part = (float(i) + 0.7) / float(kSteps);
    float share = 1.0 - exp2(-kOctaves * part * sqrt(part));
    vec3 at = (1.0 - share) * ray + share * sun;
    if (at.z < 0.02 || !near_land) break;
    vec2 seen = vec2(0.5 + at.x / at.z * camera_focal / aspect, 0.5 + at.y / at.z * camera_focal);
    vec2 outside = max(-seen, seen - 1.0);
    vec2 land = ReadLandDepth(land_depth, seen);
    float behind = 16.0 * (level - land.r) + log2(at.z / (1.0 - share));
    float soft = 0.2 + 0.8 * share;
    float hit = smoothstep(kClearance, kClearance + soft, behind)
        * (1.0 - smoothstep(kThickness, 3.0 * kThickness, behind))
        * smoothstep(0.0, 0.9, land.g)
        * (1.0 - smoothstep(-0.02, 0.0, max(outside.x, outside.y)));
    hidden = max(hidden, hit);
  }
  // At the ray's end stands the land in the sun's own direction: far land hides the sun from every place.
  if (sun.z > 0.02) {
    vec2 seen = vec2(0.5 + sun.x / sun.z * camera_focal / aspect, 0.5 + sun.y / sun.z * camera_focal);
    vec2 outside = max(-seen, seen - 1.0);
    vec2 land = ReadLandDepth(land_depth, seen);
    float farther = smoothstep(2.0, 4.0, 16.0 * (land.r - level));
    float inside = 1.0 - smoothstep(0.0, 0.1, max(outside.x, outside.y));
    hidden = max(hidden, smoothstep(0.2, 0.8, land.g) * farther * inside);
  }
  return hidden;
}

// Largest share of sunlight that clouds block: a third passes a cloud of optical depth 16,
// and light reflected by other clouds fills the shadows.
const float kCloudShade = 0.65;

// Share of the sun that clouds block at `position`, meters from the camera in world coordinates.
float GetCloudOcclusion(vec3 position, vec3 sun) {
  vec3 leaves = position + sun * (kCloudHeight - position.y) / max(sun.y, 0.03);
  vec3 seen = GetPlaceOfDirection(leaves);
  vec2 outside = max(-seen.xy, seen.xy - 1.0);
  float inside = step(0.0, seen.z) * (1.0 - smoothstep(-0.05, 0.1, max(outside.x, outside.y)));
  float veil = texelFetch(veil_opacity, ivec2(0), 0).r;
  return kCloudShade * inside * max(ReadBilinear(openness, seen.xy).b - veil, 0.0) / max(1.0 - veil, 0.1);
}

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  float level = ReadLandDepth(land_depth, place).r;
  vec3 view = GetViewDirection(place);
  float along = exp2(16.0 * level) / max(dot(view, vec3(camera_right.z, camera_up.z, camera_forward.z)), 0.1);
  Transfer land = ReadTransfer(place);
  float hidden = depth_told > 0.0 ? GetLandOcclusion(place, level, GetCameraDirection(sun)) : 0.0;
  float light = GetSunlight(land, sun) * (1.0 - hidden);
  result = vec4(1.0 - hidden, 1.0 - GetCloudOcclusion(along * view, sun), light, GetOpenness(land));
}
