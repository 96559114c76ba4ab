# docker build -t tippe-top-explorer . && docker run --rm -p 5006:5006 tippe-top-explorer; then http://localhost:5006/app
# Under another name than localhost:5006 add -e BOKEH_ALLOW_WS_ORIGIN=that.name:port

FROM python:3.12-slim AS build
WORKDIR /src
COPY . .
# Node.js, which the bundle is built with, lives and dies in pip's build environment.
RUN python3 -m venv /opt/venv \
    && /opt/venv/bin/pip install --no-cache-dir . \
    && cd /opt/venv \
    && ln -s "$(bin/python -c 'import app; print(app.__path__[0])')" app \
    && bin/pip uninstall --yes pip

FROM python:3.12-slim
COPY --from=build /opt/venv /opt/venv
ENV PATH=/opt/venv/bin:$PATH PYTHONUNBUFFERED=1
USER nobody
WORKDIR /opt/venv
EXPOSE 5006
HEALTHCHECK --start-period=30s CMD ["python", "-c", "import urllib.request as u; u.urlopen('http://localhost:5006/liveness')"]
CMD ["panel", "serve", "app", "--address", "0.0.0.0", "--port", "5006", "--liveness"]
