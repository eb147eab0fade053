"""What the vending machine of vending.json must keep."""

from rovercheck import always, implies, xstate_model

vending = xstate_model("vending.json")
coins = vending["coins"]

PROPERTIES = [
    always(
        "VEND-1", "Nothing is served that was not paid.",
        that=implies(vending.ran("motorOn"), vending["event"] == "SELECT"),
        covers=["R-1"], on=vending.system,
    ),
    always(
        "VEND-2", "Without coins the machine waits or serves.",
        that=implies(coins == 0, vending.active("idle", "serving")),
        covers=["R-2"], on=vending.system,
    ),
    always(
        "VEND-3", "What is sold out is not served.",
        that=implies(vending.ran("motorOn"), vending.guard("inStock")),
        covers=["R-1"], on=vending.system,
    ),
]  # fmt: skip
REQUIREMENTS = {
    "R-1": "Only what is paid and in stock is served.",
    "R-2": "The machine waits for coins.",
}
