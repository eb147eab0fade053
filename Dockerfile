# rovercheck as a container (docs/installation.md).
#   docker build -t rovercheck .          --build-arg EXTRAS=certificates,plot   what is installed besides
#   docker run --rm -v "$PWD:/work" rovercheck check --model heater.py

FROM python:3.12-slim AS build
ENV PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1
RUN python -m venv /opt/rovercheck
ENV PATH=/opt/rovercheck/bin:$PATH
WORKDIR /source
COPY requirements-core.lock ./
RUN pip install --require-hashes -r requirements-core.lock
ARG EXTRAS=""
COPY . .
RUN pip install --no-deps --no-build-isolation . \
    && if [ -n "$EXTRAS" ]; then pip install "rovercheck[$EXTRAS]"; fi

FROM python:3.12-slim
COPY --from=build /opt/rovercheck /opt/rovercheck
ENV PATH=/opt/rovercheck/bin:$PATH
RUN useradd --create-home --uid 1000 checker && install --directory --owner checker /work
USER checker
WORKDIR /work
ENTRYPOINT ["rovercheck"]
CMD ["--help"]
