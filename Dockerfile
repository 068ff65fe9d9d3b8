# SPDX-License-Identifier: BSD-3-Clause
# colmap_curvix in a small image of Debian:
#
#   docker build --tag colmap_curvix .
#   docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD/proj:/proj" \
#     colmap_curvix --workspace_path /proj
ARG DEBIAN=13

FROM debian:${DEBIAN}-slim AS build
WORKDIR /source
COPY examples/install_dependencies.sh examples/
RUN examples/install_dependencies.sh
COPY . .
RUN cmake --preset deb && cmake --build --preset deb --target package

FROM debian:${DEBIAN}-slim
RUN --mount=type=bind,from=build,source=/source/build-deb,target=/packages \
  apt-get update && \
  apt-get install --yes --no-install-recommends /packages/*.deb && \
  rm -rf /var/lib/apt/lists/*
ENTRYPOINT ["colmap_curvix"]
