"""The alive counter as a number beside the flags that stand for it in the link.

The composition does not carry the counter; here it is carried, modulo 16, so that the two ways of saying
"the counter of this frame is a new one" can be compared.  At most eight frames in a row are lost, so
that the counter never moves by 16 between two accepted frames.
"""

from rovercheck.spec_model.composition.link import MANY, link
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.words import modulo
from rovercheck.spec_model.system_table import SystemTable

MODULUS = 16

executes = flag("sender.executes", "the sender's supervisor executes in this step")
counter = var("sender.counter", integer(0, MODULUS - 1), doc="alive counter in the snapshot, modulo 16")
accepted = flag("receiver.accepted", "a frame was accepted since the last step")
says_new = flag("receiver.says_new", "the flags of the link say that the counter is a new one")
received = var("receiver.counter", integer(0, MODULUS - 1), doc="alive counter in the payload")
remembered = var("receiver.remembered", integer(0, MODULUS - 1), doc="the counter remembered")
differs = flag("receiver.differs", "the received counter differs from the remembered one")

counting = link("line", [(counter, received)], accepted=accepted, counter_changed=says_new, executes=executes)

count = Block(
    "Count",
    [when(executes, [assign(counter, modulo(counter + 1, MODULUS))])],
    text="The alive counter rises by 1 at every execution [spec Table 2].",
)
compare = Block(
    "Compare",
    [assign(differs, received != remembered), assign(remembered, received)],
    text="A step of the receiver looks at the counter and remembers it.",
)

counters = in_order(
    "counters",
    counting.receive,
    compare,
    count,
    counting.send,
    text="The alive counter over the link, as a number and as the flags that stand for it.",
    assume=counting.lost_at_most(MANY),
    notes=(f"The sender executes at will; at most {MANY} frames in a row are lost.",),
)

SYSTEMS = SystemTable(counters)
