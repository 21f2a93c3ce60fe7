# SPDX-License-Identifier: Apache-2.0
"""Built images, one relay for each way to build, and a listening ROS 2 process."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import AgentProcess, own_domain, running_agent
from tests.support.e2e.images import DECLARED as DECLARED_YAML
from tests.support.e2e.images import POOLS as POOLS_YAML
from tests.support.e2e.images import QUICK, Image, Images
from tests.support.e2e.live import Live
from tests.support.e2e.relay import Relay


@pytest.fixture(scope="session")
def images(tmp_path_factory: pytest.TempPathFactory) -> Images:
    base = tmp_path_factory.getbasetemp()
    return Images((base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "images")


@pytest.fixture(scope="session")
def image_port() -> Iterator[Relay]:
    """The relay whose port the examples are built for; tests give it the agent that they need."""
    with Relay() as relay:
        yield relay


@pytest.fixture
def relay(image_port: Relay) -> Iterator[Relay]:
    """The same, without an agent before and after the test."""
    image_port.connect(0)
    yield image_port
    image_port.connect(0)


@pytest.fixture(scope="session")
def profile_image(images: Images, image_port: Relay) -> Image:
    """The profile alone, as `microros-gen generate --profile pure_sender` writes it."""
    return images.build(image_port.port)


# These are for live.c, which is told where its agent is.


@pytest.fixture(scope="session")
def pool_image(images: Images) -> Image:
    """An application with pools; liveliness ping, on_full error."""
    return images.build(1, POOLS_YAML)


@pytest.fixture(scope="session")
def declared_image(images: Images) -> Image:
    """An application with declared nodes, without sanitizers."""
    return images.build(1, DECLARED_YAML, flags=QUICK)


@pytest.fixture(scope="session")
def acknack_image(images: Images) -> Image:
    """As pool_image with liveliness acknack and on_full drop_oldest, without sanitizers."""
    return images.build(1, POOLS_YAML + "liveliness: acknack\non_full: drop_oldest\n", flags=QUICK)


@pytest.fixture(scope="session")
def none_image(images: Images) -> Image:
    """As pool_image without liveliness, on_full block 20 ms, without sanitizers."""
    return images.build(1, POOLS_YAML + "liveliness: none\non_full: block 20 ms\n", flags=QUICK)


@pytest.fixture(scope="session")
def domain() -> int:
    return own_domain()


@pytest.fixture(scope="session")
def shared_agent(domain: int, images: Images, pool_image: Image) -> Iterator[AgentProcess]:
    """An agent that nobody stops; a client that falls silent leaves after three seconds.

    One client stays all the time: with the last node the agent's DDS participant goes, and its discovery
    takes a second.
    """
    with (
        running_agent(domain, "--domain", str(domain), "--client-timeout", "3") as running,
        Live(images.live(pool_image)) as keeper,
    ):
        keeper.ok(f"open 0xFFFF {running.port}")
        keeper.ok("node 0 keeper -")
        yield running


@pytest.fixture
def agent(shared_agent: AgentProcess, relay: Relay) -> AgentProcess:
    """The same, after the relay."""
    relay.connect(shared_agent.port)
    return shared_agent


@pytest.fixture(scope="session")
def shared_observer(domain: int) -> Iterator[Observer]:
    with observing(domain) as running:
        yield running


@pytest.fixture
def observer(shared_observer: Observer) -> Iterator[Observer]:
    """The same process for each test, without the subscriptions of the test before."""
    yield shared_observer
    shared_observer.ask(do="forget")
