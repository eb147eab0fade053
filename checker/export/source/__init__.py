"""Systems of charts as Python source: a model that a person can read and edit."""
