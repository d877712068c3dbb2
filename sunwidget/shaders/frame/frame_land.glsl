// The frame where a pixel is land or water and no sky (frame_parts.glsl). How land changes: land/relit_land.glsl.

#define LAND_ALONE
#include "frame/frame.glsl"
