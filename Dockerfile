# The hosted page. Build: docker build -t strikewave .   (or, without an engine: buildah bud --format docker -t strikewave .)
# Run:   docker run -p 5006:5006 -e IMPACT_ORIGINS=impact.example.org strikewave
FROM docker.io/library/node:22-bookworm-slim AS page
WORKDIR /srv/page
COPY package.json pack.js ./
RUN npm install --no-package-lock --no-audit --no-fund
COPY app/static app/static
RUN node pack.js

FROM docker.io/library/python:3.11-slim-bookworm

# One portable CPU target for building and running: kernels compiled for another CPU would be compiled again at start.
ENV NUMBA_CPU_NAME=generic \
    NUMBA_CPU_FEATURES= \
    PYTHONUNBUFFERED=1 \
    PIP_NO_CACHE_DIR=1 \
    PIP_DISABLE_PIP_VERSION_CHECK=1 \
    IMPACT_ADDRESS=0.0.0.0 \
    IMPACT_PORT=5006

WORKDIR /srv/strikewave
COPY constraints.txt pyproject.toml README.md LICENSE ./
COPY solvers solvers
COPY app app
COPY --from=page /srv/page/app/packed app/packed
RUN pip install --constraint constraints.txt . && useradd --create-home --uid 10001 impact

# Kernels are compiled by the user that runs them: Numba silently ignores a cache that it cannot write beside.
USER impact
RUN impact warm

EXPOSE 5006
# Answers once the first page is ready.
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s \
    CMD ["python", "-c", "import os, urllib.request as u; u.urlopen('http://127.0.0.1:' + os.environ['IMPACT_PORT'] + '/liveness', timeout=4)"]
CMD ["impact", "serve", "--warm"]
