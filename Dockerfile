# docker build -t tippe-top-explorer . && docker run --rm -p 5006:5006 tippe-top-explorer; then http://localhost:5006/app
# Settings are environment variables; docs/DEPLOY.md lists them.

FROM python:3.12-slim AS build
WORKDIR /src
COPY . .
# Installs the versions that were tested: locks/. Node.js, which builds the bundle, stays behind in /opt/build. Then removes
# what is never loaded here: tests, source maps, scripts of which there is a minified copy, and Panel's copies of libraries
# for panes that the page does not use.
RUN python3 -m venv /opt/build \
    && /opt/build/bin/pip install --no-cache-dir --require-hashes -r locks/build.txt \
    && /opt/build/bin/pip wheel --no-deps --no-build-isolation --wheel-dir /opt/wheel . \
    && python3 -m venv /opt/venv \
    && /opt/venv/bin/pip install --no-cache-dir --require-hashes -r locks/run.txt -r locks/redis.txt -r locks/metrics.txt \
    && /opt/venv/bin/pip install --no-deps /opt/wheel/*.whl \
    && /opt/venv/bin/pip uninstall --yes pip \
    && cd /opt/venv/lib/python3*/site-packages \
    && find . -type d -name tests -prune -exec rm -r {} + \
    && find . -name '*.map' -delete -o -name '*.pyi' -delete \
    && for full in $(find bokeh/server/static panel/dist -name '*.js'); do \
           if [ -e "${full%.js}.min.js" ]; then rm "$full"; fi; done \
    && rm -r bokeh/server/static/js/lib bokeh/server/static/js/compiler.js \
    && cd panel/dist/bundled \
    && rm -rf @microsoft abstractvtkplot aceplot bootstrap4 bootstrap5 datatabulator deckglplot echarts font-awesome \
           gridstack jquery jsoneditor material-components-web* perspective plotlyplot quillinput reveal.js* terminal vegaplot
# Kernels, compiled for any processor of this architecture, not only for the one that builds, and stored beside their
# sources. Run in /, because here Python would use the sources in /src.
RUN cd / && NUMBA_CPU_NAME=generic /opt/venv/bin/python -m tippe_core

FROM python:3.12-slim
COPY --from=build /opt/venv /opt/venv
# Votes are written to a volume, unless TIPPE_VOTES names a Redis; when the first figure is printed, matplotlib writes its
# list of fonts to memory. Nothing else is written.
RUN install -d -o 65534 -g 65534 -m 700 /var/lib/tippe
VOLUME /var/lib/tippe
# The system's malloc returns the memory of closed pages to the system; Python's own is an eighth faster, but keeps it.
# NUMBA_CPU_NAME as above, or the kernels would be compiled again.
ENV PATH=/opt/venv/bin:$PATH NUMBA_CPU_NAME=generic PYTHONUNBUFFERED=1 PYTHONDONTWRITEBYTECODE=1 PYTHONSAFEPATH=1 \
    PYTHONMALLOC=malloc MPLCONFIGDIR=/dev/shm/matplotlib TIPPE_VOTES=/var/lib/tippe/votes.sqlite
USER 65534:65534
EXPOSE 5006
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s CMD ["python", "-c", \
    "import os, urllib.request as u; u.urlopen(f\"http://localhost:{os.environ.get('TIPPE_PORT') or 5006}/liveness\", timeout=4)"]
STOPSIGNAL SIGTERM
CMD ["python", "-m", "app"]
