// The frame for pixels of land or water without sky (frame_parts.glsl). land/relit_land.glsl relights the land.

#define LAND_ALONE
#include "frame/frame.glsl"
