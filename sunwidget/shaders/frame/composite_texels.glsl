// The texels of composite_constants.glsl.

const int kGains = 0;  // exposure gain, how far the sun has moved (0..1), color lost in shade; alpha: the land's gain
                       // over the picture's, negative where the sky is as it was
const int kLyingBefore = 1;       // light on lying land
const int kUprightBefore = 2;     // on upright land
const int kLyingNow = 3;
const int kUprightNow = 4;
const int kCloudBefore = 5;       // light of a cloud
const int kCloudLobeBefore = 6;   // what its forward lobe adds
const int kCloudNow = 7;
const int kCloudLobeNow = 8;
const int kSunBefore = 9;         // direction of the sun
const int kDisc = 10;             // sky/disc.glsl: radius, sine of its middle's elevation, inverse of half its height
const int kWaterSunBefore = 11;   // the sun's light on water
const int kWaterSunNow = 12;
const int kGlare = 13;            // what camera/camera_glare.glsl's profile is multiplied with
const int kOwnDisc = 14;          // the disc as the photo shows its own, under the new light; alpha: its radius, 0 for none
// Alphas of 1-4, 5-8, 9-12: log2 of the disc's radiance in its middle, slope and bend over its height.
