# sunwidget without a display: `docker build -t sunwidget .`, then
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/photos" sunwidget render beach.jpg --sun-elevation 3 -o evening.png
# docs/export.md tells the rest. One small Debian for all stages; nothing of the first two is in the image.

FROM debian:trixie-slim AS front-end
RUN apt-get update && apt-get install -y --no-install-recommends nodejs npm && rm -rf /var/lib/apt/lists/*
WORKDIR /src
COPY js/package.json js/package-lock.json js/
# Not `npm ci`: it refuses a lock file that lacks the optional packages of other platforms.
RUN npm --prefix js install --no-save --no-audit --no-fund
COPY js js
COPY sunwidget/shaders sunwidget/shaders
RUN npm --prefix js run build

FROM debian:trixie-slim AS packages
RUN apt-get update && apt-get install -y --no-install-recommends python3-venv && rm -rf /var/lib/apt/lists/*
WORKDIR /src
COPY pyproject.toml hatch_build.py README.md LICENSE ./
COPY sunwidget sunwidget
COPY --from=front-end /src/sunwidget/static sunwidget/static
RUN python3 -m venv /build && /build/bin/pip install --no-cache-dir build \
    && /build/bin/python -m build --wheel --outdir /wheels
# No lab: a notebook server would be an image of its own.
RUN python3 -m venv /opt/sunwidget \
    && wheel=$(echo /wheels/*.whl) && /opt/sunwidget/bin/pip install --no-cache-dir "$wheel[video,batch,raw,exr]"

FROM debian:trixie-slim
# Mesa draws on the processor; EGL needs no display.
RUN apt-get update && apt-get install -y --no-install-recommends \
      python3 libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --no-create-home sunwidget && install -d -o sunwidget /photos
COPY --from=packages /opt/sunwidget /opt/sunwidget
# With --user anybody may come, and has no home.
ENV PATH=/opt/sunwidget/bin:$PATH HOME=/tmp MESA_SHADER_CACHE_DIR=/var/cache/sunwidget
# Compiling the shaders takes ten seconds of a core: once here, not in every container.
RUN python -c "import sunwidget as sw; scene = sw.analyze(sw.sample('coast').preview(96)); \
      sw.render(scene, sw.Edit(sun_elevation=4)); sw.render(scene, sw.Edit(sun_elevation=4), dtype='float32')" \
    && chmod -R a+rwX /var/cache/sunwidget
USER sunwidget
WORKDIR /photos
# `docker stop` as Ctrl-C: the command ends by itself and leaves no half-written file.
STOPSIGNAL SIGINT
ENTRYPOINT ["sunwidget"]
CMD ["doctor"]
