"""What all tests share: its presence puts tests/ on the path, so that they can import `hierarchies` and `plain`."""

from hypothesis import settings

settings.register_profile("mind", deadline=None)  # a shared machine takes its time
settings.load_profile("mind")
