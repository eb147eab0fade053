"""Why a run ends as it does: the inputs that force its end, and other runs that end so differently."""
