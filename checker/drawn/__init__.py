"""Charts drawn elsewhere: what their files hold, and what it means."""
