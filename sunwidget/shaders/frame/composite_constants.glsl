// Everything of the ratio composite that is the same for all pixels, so that no pixel computes
// it again; texels as in composite_texels.glsl.

#include "frame/composite_texels.glsl"
#include "frame/picture.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"
#include "camera/response.glsl"
#include "camera/camera_glare.glsl"
#include "sky/sky_seen.glsl"
#include "sky/tint.glsl"

uniform sampler2D columns;
uniform sampler2D land_terms;
uniform sampler2D light_before;
uniform sampler2D light_edit;
uniform sampler2D visibility_source;
uniform sampler2D visibility_edit;
uniform sampler2D meter_source;
uniform sampler2D meter_edit;
uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_size;
uniform float sun_visibility;
uniform float source_sun_visibility;
uniform float altitude;
uniform float source_sun_azimuth;
uniform float source_sun_elevation;
uniform float land_facing;
uniform float source_land_facing;
uniform float colourfulness;
uniform float exposure;
uniform float auto_exposure;
uniform float glow;
uniform vec3 photo_land_linear_mean;
uniform float photo_key;  // mean log2 of the luminance of the photo without its sun, display-linear
uniform float photo_sky_key;  // the same of its sky
uniform vec3 own_disc;  // the photo's own sun: display-linear light of its disc or burnt core
uniform float own_disc_radius;  // tangent of its angle, 0 where none is seen

out vec4 result;

// Over this many degrees of movement the old sun's glare gives way to the sky behind it: long
// enough that a pixel's drag shows no step, short enough that a moved sun leaves no ghost.
const float kGlareFade = 4.0;
// A camera that re-exposes for dusk and night stops short of what it does by day, by this much (EV)
// between these luminances (log2 of cd m^-2: 60 and 0.03): a print of a night is dark, or it is taken
// for a day. Krawczyk et al. 2005 ("Perceptual effects in real-time tone mapping", eq. 11) find 2.2 EV
// at 0.1 cd m^-2 beyond what `auto_exposure` leaves out already; less of it keeps the land readable.
const float kNightKey = 1.6;
const vec2 kNightBegins = vec2(5.9, -5.06);

// Where a sun in view would burn the sky, a camera exposes for the sky: by so much of what its mean exceeds
// this (display-linear).
const float kBrightSky = 0.35;
const float kProtection = 0.9;

// A photo is dark because of a low sun in it, or of the evening. When that has risen, it is exposed as half of the photos
// of a day are, but for no more than is in it.
const float kDayKey = -2.95;
const float kMostHidden = 2.0;
// Its sky then is as bright as that of half of the blue and white skies of a day, for no more stops than these.
const float kDaySky = -1.9;
const float kMostOfSky = 1.5;

// Cameras and phones lift land that has become darker than this (stops) by this share of the rest.
const float kDark = -1.2;
const float kLift = 0.7;
// And hold back land that would be brighter than nine in ten photos of a day have it (log2 of its mean, display-linear).
const float kBrightLand = -1.65;
const float kHeldBack = 0.8;

// A moon is 20 EV brighter than the sky it lights and would burn to a white hole; it is drawn so
// bright, of white, and dimmed less by the air, as when a second, short exposure is laid over.
const float kMoonLevel = 0.85;
const float kMoonDimming = 0.35;

vec2 GetMeter(sampler2D meter) {
  return texelFetch(meter, ivec2(0), 0).rg;
}

// `meter` as meter.glsl has it, of the photo's unit.
float GetNightStops(float meter) {
  float luminance = meter + log2(1000.0 / GetLuminance(sky_gain)) + photo_light * log2(kMoonOverSun.g);
  return kNightKey * (1.0 - smoothstep(kNightBegins.y, kNightBegins.x, luminance));
}

// Stops by which one exceeds another, softly: 1 where they are alike.
float GetExcess(float stops) {
  return log2(1.0 + exp2(stops));
}

// How far the sky's bright side, log2 of display white, is over what a camera lets pass.
float GetStopsTooBright(float level) {
  float over = level - log2(GetSceneLight(vec3(kBrightSky)).g);
  return kProtection * GetExcess(over);
}

float GetRisen() {
  return GetRisen(GetSunDirection(source_sun_azimuth, source_sun_elevation),
                  GetSunDirection(sun_azimuth, sun_elevation));
}

// What a fully automatic exposure does by day: it follows the mean, and holds back for a bright sky.
float GetDayStops() {
  vec2 before = GetMeter(meter_source);
  vec2 now = GetMeter(meter_edit);
  float stops = before.r - now.r + GetRisen() * clamp(kDayKey - photo_key, 0.0, kMostHidden);
  return stops - (GetStopsTooBright(now.g + stops) - GetStopsTooBright(before.g));
}

// By how much the sky, and what mirrors it, is lifted beyond the land.
float GetSkyLift() {
  float level = photo_sky_key + GetMeter(meter_edit).g - GetMeter(meter_source).g + GetDayStops();
  return GetSkySeen() * auto_exposure * GetRisen() * clamp(kDaySky - level, 0.0, kMostOfSky);
}

float GetStops() {
  float night = GetNightStops(GetMeter(meter_edit).r) - GetNightStops(GetMeter(meter_source).r);
  return exposure + GetRestraint() * auto_exposure * (GetDayStops() - night) + GetSkyLift();
}

// The glare of a sun in a picture that is exposed for it: with another exposure it is as much brighter.
vec3 GetGlare() {
  vec3 beam = GetLightScale(GetMoon()) * GetLightTexel(light_edit, 1);
  float light = GetLuminance(beam);
  float visible = texelFetch(visibility_edit, ivec2(0), 0).g;
  // Cameras balance their white half way. A red tint of the photo dyes the sun's light, a blue one its sky.
  vec3 color = sqrt(beam * (sky_gain.r > sky_gain.b ? sky_gain : vec3(1.0)));
  return glow * visible * exp2(GetStops() - GetSkyLift() - GetDayStops()) * GetGlareStrength(light) * color / GetLuminance(color);
}

// Light of the land, lying and upright, by its part of land_terms.glsl: luminance.
float GetLandLevel(int first, vec2 share) {
  vec3 sun = texelFetch(land_terms, ivec2(first + 7, 0), 0).xyz;
  vec3 sky = texelFetch(land_terms, ivec2(first, 0), 0).rgb + texelFetch(land_terms, ivec2(first + 4, 0), 0).rgb;
  float cosine = GetSoftCosine(sun.y, kRoughness) + GetSoftCosine(-sun.z, kRoughness);
  return GetLuminance(sky + share.x * share.y * cosine * texelFetch(land_terms, ivec2(first + 6, 0), 0).rgb);
}

// Log2 of how far land of this mean is over what is held back.
float GetTooBright(float level) {
  return GetExcess(2.0 * (level - kBrightLand)) / 2.0;
}

// Stops by which a camera lifts land that has become dark, and holds back what has become bright.
float GetLift() {
  vec4 share = texelFetch(land_terms, ivec2(16, 0), 0);
  float stops = auto_exposure * GetDayStops() + log2(GetLandLevel(8, share.zw) / GetLandLevel(0, share.xy));
  stops *= GetRestraint();
  float lift = kLift * (GetExcess(kDark - stops) - GetExcess(kDark));
  float level = log2(max(GetLuminance(photo_land_linear_mean), 1e-4));
  return auto_exposure * (lift - kHeldBack * (GetTooBright(level + stops) - GetTooBright(level))) - GetSkyLift();
}

// log2 of the radiance in the middle of a disc at this height, without its limb's darkening.
vec4 GetDiscRadiance(float sine_of_elevation) {
  vec4 path = log2(max(GetTransmittanceToTop(columns, altitude, sine_of_elevation), vec4(1e-30)));
  vec4 sun = log2(kSolarIrradiance / (kPi * kSunAngularRadius * kSunAngularRadius)
      * (0.5 * kLimbDarkening + 1.0)) + path;
  float level = GetSceneLight(vec3(kMoonLevel)).g / GetLuminance(sky_gain * SpectralToRec709(kSolarIrradiance));
  vec4 moon = log2(kSolarIrradiance * level) - GetStops() + exposure + kMoonDimming * path;
  return mix(sun, moon, GetMoon()) + log2(max(sun_visibility, 1e-9));
}

// The light that a sky sends in all directions is the same to the bit only when the sky is.
bool IsSkyUnchanged() {
  bool same = sun_azimuth == source_sun_azimuth && sun_elevation == source_sun_elevation
      && GetMoon() == photo_light && sun_visibility == source_sun_visibility;
  for (int i = 0; i < 9; ++i) {
    same = same && texelFetch(light_before, ivec2(i, 0), 0) == texelFetch(light_edit, ivec2(i, 0), 0);
  }
  return same;
}

// Brightest that a disc becomes over the photo's own.
const float kBrightestDisc = 4.0;

// The photo's own disc under the new sun's light. What burnt to white is not known to be brighter, and a camera
// exposes for the sun it sees, so its luminance goes as glare does and its color as the light's.
vec3 GetOwnDisc() {
  vec3 before = max(GetLightTexel(light_before, 1), vec3(1e-9));
  vec3 now = max(GetLightTexel(light_edit, 1), vec3(0.0));
  float level = GetLuminance(now) / GetLuminance(before);
  vec3 hue = now / before / max(level, 1e-9);
  return sun_visibility * GetSceneLight(own_disc) * min(hue, vec3(kBrightestDisc)) * min(pow(level, kGlareGrowth), kBrightestDisc);
}

vec3 GetForwardLight(sampler2D light) {
  return GetCloudRadiance(light, 1.0) - GetCloudRadiance(light, 0.0);
}

void main() {
  int index = int(gl_FragCoord.x);
  vec3 sun_before = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  float visible_before = texelFetch(visibility_source, ivec2(0), 0).r;
  float visible_now = texelFetch(visibility_edit, ivec2(0), 0).r;
  float radius = kSunAngularRadius * sun_size;
  // From the horizon, or the lower edge above it, to the upper one.
  float low = max(sun_now.y - radius, GetCosineOfHorizon(altitude));
  float high = max(sun_now.y + radius, low + 1e-4);
  vec4 middle = GetDiscRadiance(0.5 * (low + high));
  vec4 lower = GetDiscRadiance(low);
  vec4 upper = GetDiscRadiance(high);
  mat3x4 parabola = mat3x4(middle, 0.5 * (upper - lower), 0.5 * (upper + lower) - middle);
  int part = max(index - 1, 0);
  float disc = parabola[part / 4][part % 4];
  if (index == kGains) {
    float turn = degrees(2.0 * asin(min(0.5 * length(sun_now - sun_before), 1.0)));
    // As the landscape sees the sun on average, not the camera alone; a sun that comes out gives
    // the color back.
    vec4 reached = texelFetch(land_terms, ivec2(16, 0), 0);
    float hidden = reached.x * reached.y * source_sun_visibility - reached.z * reached.w * sun_visibility;
    bool same = visible_before == visible_now && IsSkyUnchanged();
    // Another light has another disc and another glow, also in the same place.
    // A sun that is taken away leaves the sky behind it, as one that moves does.
    float moved = GetMoon() == photo_light
        ? max(smoothstep(0.0, kGlareFade, turn), source_sun_visibility - sun_visibility) : 1.0;
    result = vec4(exp2(GetStops()), moved, 0.5 * hidden * colourfulness, (same ? -1.0 : 1.0) * exp2(GetLift()));
  } else if (index == kSunBefore) {
    result = vec4(sun_before, disc);
  } else if (index == kDisc) {
    result = vec4(radius, 0.5 * (low + high), 2.0 / (high - low), disc);
  } else if (index == kOwnDisc) {
    result = vec4(GetOwnDisc(), GetMoon() == photo_light ? own_disc_radius * sun_size : 0.0);
  } else {
    vec3 light = index == kLyingBefore ? GetLandIrradiance(light_before, visible_before, source_land_facing, sun_before)
        : index == kUprightBefore ? GetLandIrradiance(light_before, visible_before, 1.0, sun_before)
        : index == kLyingNow ? GetLandIrradiance(light_edit, visible_now, land_facing, sun_now)
        : index == kUprightNow ? GetLandIrradiance(light_edit, visible_now, 1.0, sun_now)
        : index == kCloudBefore ? GetCloudRadiance(light_before, 0.0)
        : index == kCloudLobeBefore ? GetForwardLight(light_before)
        : index == kCloudNow ? GetCloudRadiance(light_edit, 0.0)
        : index == kCloudLobeNow ? GetForwardLight(light_edit)
        : index == kGlare ? GetGlare()
        : index == kWaterSunBefore ? visible_before * GetLightTexel(light_before, 1)
        : visible_now * GetLightTexel(light_edit, 1);
    // Without a moon no light reaches a surface but the night sky's, from half the sphere.
    float moon = index == kLyingNow || index == kUprightNow || index == kCloudNow || index == kCloudLobeNow || index == kWaterSunNow ? GetMoon() : photo_light;
    float night = index <= kUprightNow ? kPi : index == kCloudBefore || index == kCloudNow ? 1.0 : 0.0;
    result = index == kGlare ? vec4(light, 0.0)
        : vec4(sky_gain * (GetLightScale(moon) * light + night * GetNightSky(moon)), disc);
  }
}
