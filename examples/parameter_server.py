# SPDX-License-Identifier: Apache-2.0
"""A parameter server of one's own, in some fifty lines: it holds values in memory, without checks, events or a file."""

import random

import rclpy
from microros_parameter_msgs.msg import HeldParameter, Notice
from microros_parameter_msgs.srv import Exchange
from rcl_interfaces.msg import Parameter, SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.qos import DurabilityPolicy, QoSProfile

ASK = Exchange.Request


class HeldNode:
    """The values of one node, and the services in its name."""

    def __init__(self, name):
        self.values, self.group = {}, ReentrantCallbackGroup()
        self.client = node.create_client(Exchange, f"{name}/exchange_parameters", callback_group=self.group)
        node.create_service(GetParameters, f"{name}/get_parameters", self.get)
        node.create_service(SetParameters, f"{name}/set_parameters", self.set)

    async def ask(self, what, **members):
        """Return the response of the board; after 2 s without one it counts as away."""
        self.number += 1
        members |= {"board": self.board, "session": self.session, "number": self.number}
        future = self.client.call_async(ASK(what=what, **members))
        timer = node.create_timer(2.0, future.cancel, self.group)
        response = await future
        node.destroy_timer(timer)
        return response or Exchange.Response(successful=True, reason="held until the node is back")

    async def follow(self, notice):
        """List what the node has, set what is held, acknowledge."""
        self.board, self.session, self.number = notice.board, random.randrange(1, 1 << 32), 0
        page = first = await self.ask(ASK.BEGIN)
        items = list(page.parameters)
        while page.next < page.total:
            page = await self.ask(ASK.LIST, first=page.next)
            items += page.parameters
        for item in items:
            name = item.descriptor.name
            held = self.values.setdefault(name, item.value)
            if item.change == HeldParameter.CHANGED:
                self.values[name] = item.value
            elif held != item.value:
                await self.ask(ASK.SET, parameters=[Parameter(name=name, value=held)])
        await self.ask(ASK.ACKNOWLEDGE, revision=first.revision)

    def get(self, request, response):
        """Answer with values that are held."""
        return GetParameters.Response(values=[self.values[n] for n in request.names if n in self.values])

    async def set(self, request, response):
        """Let the board decide."""
        for wanted in request.parameters:
            told = await self.ask(ASK.SET, parameters=[wanted])
            self.values |= {wanted.name: wanted.value} if told.successful else {}
            response.results.append(SetParametersResult(successful=told.successful, reason=told.reason))
        return response


async def noticed(notice):
    """Follow a node; the first notice of it begins its services."""
    nodes[notice.node] = nodes.get(notice.node) or HeldNode(notice.node)
    await nodes[notice.node].follow(notice)


rclpy.init()
node, nodes = rclpy.create_node("microros_parameters"), {}
kept = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(Notice, "/microros_parameters/notices", noticed, kept)
print("parameter server ready:", node.get_fully_qualified_name(), flush=True)
rclpy.spin(node)
