// The values of the ratio composite that all pixels share, computed once. composite_texels.glsl lists the texels.

#include "frame/composite_texels.glsl"
#include "frame/picture.glsl"
#include "frame/rolled.glsl"
#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "sky/daylight.glsl"
#include "camera/response.glsl"
#include "camera/camera_glare.glsl"
#include "sky/day_color.glsl"
#include "sky/sky_seen.glsl"
#include "sky/sun_visible.glsl"
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
uniform float starburst;
uniform vec3 photo_land_linear_mean;
uniform float photo_key;  // mean log2 of the luminance of the photo without its sun, display-linear
uniform float photo_sky_key;  // the same for its sky
uniform vec3 own_disc;  // the photo's own sun: display-linear light of its disc or clipped core
uniform float own_glints;  // luminance of the light that its glints on water tell of, scene-linear; 0 without glints
uniform float own_disc_radius;  // tangent of its angular radius, 0 if no sun is visible

out vec4 result;

// The old sun's glare fades to the sky behind it over this many degrees of movement: long enough that
// dragging by a pixel shows no step, short enough that a moved sun leaves no ghost.
const float kGlareFade = 4.0;
// At dusk and night a camera's re-exposure stops short of its daytime amount, by up to this much (EV) between
// these luminances (log2 of cd m^-2: 60 and 0.03): a night picture must be dark or it looks like day.
// Krawczyk et al. 2005 ("Perceptual effects in real-time tone mapping", eq. 11) find 2.2 EV at 0.1 cd m^-2
// beyond what `auto_exposure` already leaves out; a smaller amount keeps the land readable.
const float kNightKey = 1.6;
const vec2 kNightBegins = vec2(5.9, -5.06);

// The amounts (EV) by which dusk is darker than a meter makes it where no sky is visible, and where it is: there a photo
// of the dusk that becomes a day is exposed like others of the day.
const vec2 kDuskStops = vec2(1.4, 0.5);
// Photos as dark as the first (mean log2 of display-linear luminance) are dark enough, the second are not.
const vec2 kDarkEnough = vec2(-3.5, -2.5);

// If a visible sun would clip the sky, a camera exposes for the sky: it reduces the exposure by kProtection
// of the amount by which the sky's mean exceeds kBrightSky (display-linear).
const float kBrightSky = 0.35;
const float kProtection = 0.9;

// A picture that shows a sun of 10 to 20 degrees is exposed by this much (EV) less than the same one without: by skies and
// lands of 45 photos of such suns, compared with pictures whose sun was moved there, it were 1.05, but readers prefer less.
// A sun that leaves the picture does not brighten it: most photos that show one are dark for other reasons.
const float kSunInView = 0.6;

// Share of the glow of a sun that appears by day which no cloud hides: it lowers the sky's light from the first on.
const vec2 kGlowSeen = vec2(0.35, 0.65);

// Light in the mirrored glow of a hidden sun, as a share of that in the mirrored sun.
const float kMirroredGlow = 0.5;

// A photo is dark because of a low sun in it or the evening. Once the sun has risen, the picture is exposed like half
// of the daytime photos (mean log2 of display-linear luminance). It is raised by at most kMaxDayLift stops, because a
// dark photo holds no more light.
const float kDayKey = -2.95;
const float kMaxDayLift = 2.0;
// Its sky is then as bright as half of the blue and white daytime skies, raised by at most kMaxSkyLift stops.
const float kDaySky = -1.9;
const float kMaxSkyLift = 1.5;

// Cameras and phones lift land that has become darker than kDark (stops) by kLift of the rest.
const float kDark = -1.2;
const float kLift = 0.7;
// They reduce land that would be brighter than in nine of ten daytime photos (log2 of its mean, display-linear)
// by kBrightLandReduction of the excess.
const float kBrightLand = -1.65;
const float kBrightLandReduction = 0.8;

// A moon is 20 EV brighter than the sky it lights and would clip to a white hole. It is drawn at this share of
// white, and dimmed less by the air, as if by a second, short exposure.
const float kMoonLevel = 0.85;
const float kMoonDimming = 0.35;

vec2 GetMeter(sampler2D meter) {
  return texelFetch(meter, ivec2(0), 0).rg;
}

// `meter` is the value of meter.glsl, in the photo's unit.
float GetNightStops(float meter) {
  float luminance = meter + log2(1000.0 / GetLuminance(sky_gain)) + photo_light * log2(kMoonOverSun.g);
  return kNightKey * (1.0 - smoothstep(kNightBegins.y, kNightBegins.x, luminance));
}

// Softened excess of one level over another, in stops: 1 where they are equal.
float GetExcess(float stops) {
  return log2(1.0 + exp2(stops));
}

// Stops by which the sky's bright side (log2 of display white) exceeds what a camera accepts.
float GetSkyExcess(float level) {
  float over = level - log2(GetSceneLight(vec3(kBrightSky)).g);
  return kProtection * GetExcess(over);
}

float GetRisen() {
  return GetRisen(GetSunDirection(source_sun_azimuth, source_sun_elevation),
                  GetSunDirection(sun_azimuth, sun_elevation));
}

// Stops by which a sun in the picture lowers the exposure.
float GetSunStops(sampler2D visibility, float height) {
  return kSunInView * texelFetch(visibility, ivec2(0), 0).b
      * smoothstep(0.0, 10.0, height) * smoothstep(-35.0, -20.0, -height);
}

// The share of the sun's light that water mirrors: a sun behind clouds leaves its glow, in the same place.
float GetMirroredShare(vec4 visible) {
  return max(visible.r, kMirroredGlow * visible.g);
}

// Stops of the picture's exposure: `day` those of a fully automatic one by day, `sky` those by which the sky, and what
// mirrors it, is lifted more than the land, `all` with the user's.
struct Stops {
  float day;
  float sky;
  float all;
};

// It follows the mean, less the reduction for a bright sky.
float GetDayStops() {
  vec2 before = GetMeter(meter_source);
  vec2 now = GetMeter(meter_edit);
  float stops = before.r - now.r + GetRisen() * clamp(kDayKey - photo_key, 0.0, kMaxDayLift);
  stops -= GetSkyExcess(now.g + stops) - GetSkyExcess(before.g);
  float sun = GetSunStops(visibility_edit, sun_elevation) - GetSunStops(visibility_source, source_sun_elevation);
  return stops - max(sun, 0.0);
}

float GetSkyLift(float day) {
  float level = photo_sky_key + GetMeter(meter_edit).g - GetMeter(meter_source).g + day;
  return GetSkySeen() * auto_exposure * GetRisen() * clamp(kDaySky - level, 0.0, kMaxSkyLift);
}

Stops GetStops() {
  float day = GetDayStops();
  float sky = GetSkyLift(day);
  float night = GetNightStops(GetMeter(meter_edit).r) - GetNightStops(GetMeter(meter_source).r);
  // A meter that sees no bright sky restores the land's daylight, but dusk must look like dusk.
  float dusk = GetDusk(sun_elevation) - GetDusk(source_sun_elevation);
  dusk *= mix(kDuskStops.x, kDuskStops.y * max(dusk, 0.0) * smoothstep(kDarkEnough.x, kDarkEnough.y, photo_key),
              GetSkySeen());
  return Stops(day, sky, exposure + auto_exposure * (GetRestraint(sun_elevation) * (day - night) - dusk) + sky);
}

// The reddest glare, of luminance 1: seven in ten photos of suns have none redder (of 56; their median, 2, .8 and .2, looks
// olive in red skies).
const vec3 kReddestGlare = vec3(2.4, 0.65, 0.15);

// The glare of a sun in a picture that is exposed for it, scaled with any other exposure.
vec3 GetGlare(Stops stops) {
  vec3 beam = GetLightScale(GetMoon()) * GetLightTexel(light_edit, 1);
  // A camera is exposed for the sun that it shows: as that sun sinks, its glare stays as strong.
  float before = GetLuminance(GetLightScale(photo_light) * GetLightTexel(light_before, 1));
  float light = max(GetLuminance(beam), sun_visible * before);
  float visible = texelFetch(visibility_edit, ivec2(0), 0).g;
  // Cameras balance white half way. A red tint of the photo colors the sun's light, a blue one only its sky.
  vec3 color = sqrt(beam * (sky_gain.r > sky_gain.b ? sky_gain : vec3(1.0)));
  return glow * visible * exp2(stops.all - stops.sky - stops.day) * GetGlareStrength(light)
      * LimitRed(color / GetLuminance(color), kReddestGlare);
}

// Luminance of the light on land, level and upright, from its texels of land_terms.glsl. `share` is the share of the
// sun past land, and past clouds.
float GetLandLevel(int first, vec2 share) {
  vec3 sun = texelFetch(land_terms, ivec2(first + 7, 0), 0).xyz;
  vec3 sky = texelFetch(land_terms, ivec2(first, 0), 0).rgb + texelFetch(land_terms, ivec2(first + 4, 0), 0).rgb;
  float cosine = GetSoftCosine(sun.y, kRoughness) + GetSoftCosine(-sun.z, kRoughness);
  return GetLuminance(sky + share.x * share.y * cosine * texelFetch(land_terms, ivec2(first + 6, 0), 0).rgb);
}

// Stops by which the land's mean, `level`, exceeds bright land.
float GetLandExcess(float level) {
  return GetExcess(2.0 * (level - kBrightLand)) / 2.0;
}

// Stops by which a camera lifts land that has become dark and reduces land that has become bright.
float GetLift(Stops exposed) {
  vec4 share = texelFetch(land_terms, ivec2(16, 0), 0);
  float stops = auto_exposure * exposed.day + log2(GetLandLevel(8, share.zw) / GetLandLevel(0, share.xy));
  stops *= GetRestraint(sun_elevation);
  float lift = kLift * (GetExcess(kDark - stops) - GetExcess(kDark));
  float level = log2(max(GetLuminance(photo_land_linear_mean), 1e-4));
  return auto_exposure * (lift - kBrightLandReduction * (GetLandExcess(level + stops) - GetLandExcess(level)))
      - exposed.sky;
}

// log2 of the radiance at the center of a disc at this height, before limb darkening.
vec4 GetDiscRadiance(float sine_of_elevation, Stops stops) {
  vec4 path = log2(max(GetTransmittanceToTop(columns, altitude, sine_of_elevation), vec4(1e-30)));
  vec4 sun = log2(kSolarIrradiance / (kPi * kSunAngularRadius * kSunAngularRadius)
      * (0.5 * kLimbDarkening + 1.0)) + path;
  float level = GetSceneLight(vec3(kMoonLevel)).g / GetLuminance(sky_gain * SpectralToRec709(kSolarIrradiance));
  vec4 moon = log2(kSolarIrradiance * level) - stops.all + exposure + kMoonDimming * path;
  return mix(sun, moon, GetMoon()) + log2(max(sun_visibility, 1e-9));
}

// Whether the sky is the same to the bit, judged by the light that it sends in all directions.
bool IsSkyUnchanged() {
  bool same = sun_azimuth == source_sun_azimuth && sun_elevation == source_sun_elevation
      && GetMoon() == photo_light && sun_visibility == source_sun_visibility;
  for (int i = 0; i < GetSteps(9, frame_size); ++i) {
    same = same && texelFetch(light_before, ivec2(i, 0), 0) == texelFetch(light_edit, ivec2(i, 0), 0);
  }
  return same;
}

// How far a sun has come into the picture: then a camera stops down (beside_sun.glsl).
float GetAppeared() {
  float seen = texelFetch(visibility_edit, ivec2(0), 0).b - texelFetch(visibility_source, ivec2(0), 0).b;
  return auto_exposure * smoothstep(kGlowSeen.x, kGlowSeen.y, seen);
}

// How far the rays of a full starburst stretch the glare, in stops of the squared angle (chosen by eye). Lenses draw
// them around a hard, bright sun in a clear sky. A photo that shows its own sun shows its own rays.
const float kRays = 1.6;

// Largest factor by which the photo's own disc becomes brighter.
const float kBrightestDisc = 4.0;
// Stops by which a disc that the photo clips is brighter than white.
const float kBeyondWhite = 2.0;

// Light of the sun now over that of the photo's.
float GetLevel() {
  return GetLuminance(GetLightTexel(light_edit, 1)) / GetLuminance(GetLightTexel(light_before, 1));
}

// The factor of the photo's own sun in the picture. Its true light is unknown where it clips, and a camera exposes for a
// visible sun, so it changes as the glare does.
float GetOwnChange() {
  return pow(GetLevel(), kGlareGrowth);
}

// The photo's own disc under the new sun's light: its luminance changes as the glare's, and its color as the sunlight's.
vec3 GetOwnDisc() {
  vec3 hue = GetLightTexel(light_edit, 1) / GetLightTexel(light_before, 1) / GetLevel();
  vec3 change = min(GetOwnChange(), kBrightestDisc) * min(hue, vec3(kBrightestDisc));
  // As a clipped disc dims it stays white at first.
  float beyond = exp2(kBeyondWhite * smoothstep(0.9, 0.98, max(own_disc.r, own_disc.g)));
  vec3 disc = GetSceneLight(own_disc) * max(change, min(beyond * change, vec3(1.0)));
  // Where the photo clips it, it is whiter than its light: it becomes no bluer than white, nor violet.
  disc.g = min(disc.g, disc.r);
  disc.b = min(disc.b, disc.g);
  return sun_visibility * disc;
}

// Least luminance of the new sun's light on water, by the glints of the photo's own.
float GetOwnGlints() {
  return own_glints * GetMirroredShare(texelFetch(visibility_edit, ivec2(0), 0)) * min(GetOwnChange(), 1.0);
}

void main() {
  int index = int(gl_FragCoord.x);
  vec3 sun_before = GetSunDirection(source_sun_azimuth, source_sun_elevation);
  vec3 sun_now = GetSunDirection(sun_azimuth, sun_elevation);
  vec4 visible_before = texelFetch(visibility_source, ivec2(0), 0);
  vec4 visible_now = texelFetch(visibility_edit, ivec2(0), 0);
  float radius = kSunAngularRadius * sun_size;
  // Sines of the elevations of the disc's lower edge, or of the horizon if that is higher, and of its upper edge.
  float low = max(sun_now.y - radius, GetCosineOfHorizon(altitude));
  float high = max(sun_now.y + radius, low + 1e-4);
  Stops stops = GetStops();
  mat3x4 at;  // the disc's lower edge, middle and upper edge
  for (int i = 0; i < GetSteps(3, frame_size); ++i) at[i] = GetDiscRadiance(mix(low, high, 0.5 * float(i)), stops);
  mat3x4 parabola = mat3x4(at[1], 0.5 * (at[2] - at[0]), 0.5 * (at[2] + at[0]) - at[1]);
  int part = max(index - 1, 0);
  float disc = parabola[part / 4][part % 4];
  if (index == kGains) {
    float turn = degrees(2.0 * asin(min(0.5 * length(sun_now - sun_before), 1.0)));
    // Mean over the landscape, not the sun at the camera alone. A sun that comes out restores the color.
    vec4 reached = texelFetch(land_terms, ivec2(16, 0), 0);
    float hidden = reached.x * reached.y * source_sun_visibility - reached.z * reached.w * sun_visibility;
    bool same = visible_before.r == visible_now.r && IsSkyUnchanged();
    // A different light source has a different disc and glow even in the same place.
    // A removed sun reveals the sky behind it, as a moved one does.
    float moved = GetMoon() == photo_light
        ? max(smoothstep(0.0, kGlareFade, turn), source_sun_visibility - sun_visibility) : 1.0;
    result = vec4(exp2(stops.all), moved, 0.5 * hidden * colourfulness, (same ? -1.0 : 1.0) * exp2(GetLift(stops)));
  } else if (index == kSunBefore) {
    result = vec4(sun_before, disc);
  } else if (index == kDisc) {
    result = vec4(radius, 0.5 * (low + high), 2.0 / (high - low), disc);
  } else if (index == kBesideSun) {
    // A high sun in a photo that shows none.
    float day = (1.0 - max(sun_visible, photo_light)) * smoothstep(kDay.x, kDay.y, sun_now.y);
    float rays = kRays * starburst * day * GetBlueSky() * visible_now.r;
    result = vec4(day * GetAppeared(), log2(max(GetLuminance(GetSceneLight(photo_sky_linear_mean)), 1e-6)), rays, day);
  } else if (index == kGlare) {
    result = vec4(GetGlare(stops), GetMoon() == photo_light ? GetOwnGlints() : 0.0);
  } else if (index == kOwnDisc) {
    result = vec4(GetOwnDisc(), GetMoon() == photo_light ? own_disc_radius * sun_size : 0.0);
  } else {
    bool now = index == kLevelLandNow || index == kUprightLandNow || index == kCloudNow || index == kCloudLobeNow
        || index == kWaterSunNow;
    Daylight daylight = ReadDaylight(light_before);
    if (now) daylight = ReadDaylight(light_edit);
    float upright = index == kUprightLandBefore || index == kUprightLandNow ? 1.0
        : now ? land_facing : source_land_facing;
    vec4 visible = now ? visible_now : visible_before;
    vec3 cloud = GetCloudRadiance(daylight, 0.0);
    vec3 light = index <= kUprightLandNow
        ? GetLandIrradiance(daylight, visible.r, upright, now ? sun_now : sun_before)
        : index == kCloudBefore || index == kCloudNow ? cloud
        : index == kCloudLobeBefore || index == kCloudLobeNow ? GetCloudRadiance(daylight, 1.0) - cloud
        : GetMirroredShare(visible) * daylight.sun;
    // Without a moon a surface receives only the night sky's light, from half the sphere.
    float moon = now ? GetMoon() : photo_light;
    float night = index <= kUprightLandNow ? kPi : index == kCloudBefore || index == kCloudNow ? 1.0 : 0.0;
    result = vec4(sky_gain * (GetLightScale(moon) * light + night * GetNightSky(moon)), disc);
  }
}
