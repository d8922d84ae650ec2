"""Problems: Linear methods: LQR."""
