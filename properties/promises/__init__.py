"""The promises of the document, from the measured datum to the command: whole boards, no slice in between.

Each begins at what is measured, received or pressed and ends at a reference, a command, the relay or a mask
that the other board gets.  ``tests/properties/test_promises.py`` sees to that.
"""
