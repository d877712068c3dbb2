// The thesis' rendered sky S: the model, developed like a photo and color-matched (3.2.3).
// thesis_statistics holds the model's own lαβ mean and deviation at the photo's sun.

uniform vec3 photo_sky_mean;       // lαβ of the photo's sky pixels
uniform vec3 photo_sky_deviation;

vec3 GetThesisSky(vec3 matched_scene_light, vec3 model_mean, vec3 model_deviation) {
  return min(TransferColor(GetDisplayLight(matched_scene_light), model_mean, model_deviation,
                           photo_sky_mean, photo_sky_deviation), vec3(4.0));
}

vec3 GetThesisSky(vec3 matched_scene_light, sampler2D thesis_statistics) {
  return GetThesisSky(matched_scene_light, texelFetch(thesis_statistics, ivec2(0, 0), 0).rgb,
                      texelFetch(thesis_statistics, ivec2(1, 0), 0).rgb);
}
