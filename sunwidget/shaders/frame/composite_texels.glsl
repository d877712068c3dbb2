// The texels of composite_constants.glsl.

const int kGains = 0;  // exposure gain, how far the sun has moved (0..1), share of color lost in shade; alpha: the
                       // land's gain relative to the picture's, negative if the sky is unchanged
const int kLevelLandBefore = 1;   // light on level land
const int kUprightLandBefore = 2; // on upright land
const int kLevelLandNow = 3;
const int kUprightLandNow = 4;
const int kCloudBefore = 5;       // light of a cloud
const int kCloudLobeBefore = 6;   // what its forward lobe adds
const int kCloudNow = 7;
const int kCloudLobeNow = 8;
const int kSunBefore = 9;         // direction of the photo's sun
const int kDisc = 10;             // sky/disc.glsl: radius, sine of its center's elevation, inverse of half its height
const int kWaterSunBefore = 11;   // the sun's light on water
const int kWaterSunNow = 12;
const int kGlare = 13;            // factor for the profile of camera/camera_glare.glsl; alpha: least luminance of the
                                  // light of glints
const int kOwnDisc = 14;          // the photo's own disc under the new light; alpha: its radius, 0 for none
const int kBesideSun = 15;        // camera/beside_sun.glsl: how far a sun has appeared by day, log2 of the photo's mean sky, rays, day
// Alphas of 1-4, 5-8, 9-12: log2 of the disc's radiance at its center, its slope and its curvature over the height.
