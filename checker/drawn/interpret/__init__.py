"""What a drawn model does, step by step, with MATLAB's numbers: written apart from any lowering."""
